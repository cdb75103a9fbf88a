// What the process of a run says, on its way to the server.
#pragma once

#include <string>
#include <variant>

#include "serve/talk/codec.hpp"

namespace vagus::serve {

class Teller {
public:
    // Borrowed.
    explicit Teller(Pipe& pipe) : pipe_(pipe) {}

    // While mute it says that it is there, how far it is, and what is wrong; with `past` also what
    // a history keeps.
    void be_mute(bool mute, bool past = false) {
        mute_ = mute;
        past_ = past;
    }
    void tell(const talk::News& news) {
        if (mute_ && !is_told_anyway(news) && !(past_ && is_history(news))) return;
        if (!pipe_.send(talk::encode(news))) lost_ = true;
    }
    void answer(uint64_t request, const Status& done) {
        tell(talk::Answer{.request = request, .why = done.ok() ? "" : done.error().what});
    }
    void answer(uint64_t request, const Result<uint32_t>& done) {
        if (!done.ok()) return answer(request, Status(done.error()));
        tell(talk::Answer{.request = request, .number = done.value()});
    }
    void line(talk::LineKind kind, const std::string& text) { tell(talk::Line{kind, text}); }

    // The server has not taken yet what was told last.
    bool is_behind() const { return pipe_.has_unsent(); }
    // Nobody hears any more: the other end is gone, or takes nothing.
    bool is_lost() const { return lost_; }

private:
    static bool is_told_anyway(const talk::News& news) {
        return std::holds_alternative<talk::Alive>(news) ||
               std::holds_alternative<talk::Opening>(news) ||
               std::holds_alternative<talk::OpenFailed>(news) ||
               std::holds_alternative<talk::Clock>(news) ||
               std::holds_alternative<talk::Line>(news);
    }

    static bool is_history(const talk::News& news) {
        return std::holds_alternative<talk::PlanVersion>(news) ||
               std::holds_alternative<talk::Traced>(news) ||
               std::holds_alternative<talk::HappenedNow>(news) ||
               std::holds_alternative<talk::PictureThen>(news) ||
               std::holds_alternative<talk::Records>(news);
    }

    Pipe& pipe_;
    bool mute_ = false;
    bool past_ = false;
    bool lost_ = false;
};

}  // namespace vagus::serve
