// What the process of a run says, on its way to the server.
#pragma once

#include <string>

#include "serve/talk/codec.hpp"

namespace vagus::serve {

class Teller {
public:
    // Borrowed.
    explicit Teller(Pipe& pipe) : pipe_(pipe) {}

    void tell(const talk::News& news) {
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
    Pipe& pipe_;
    bool lost_ = false;
};

}  // namespace vagus::serve
