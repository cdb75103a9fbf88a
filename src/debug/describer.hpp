// Gets the description of one node: asks, collects, asks again for what is missing, ends after
// a bounded number of tries (wire spec, 2.6 and 2.9).
#pragma once

#include "debug/description.hpp"
#include "debug/outbox.hpp"

namespace vagus::debug {

constexpr int kFragmentTriesMax = 3;  // then the whole description is asked for at once

class Describer {
public:
    enum class State {
        Idle,
        Waiting,  // for its turn: see debug/turns.hpp
        Asking,
        Done,
        Failed,  // why() says why; a header that arrives all the same begins again
    };

    explicit Describer(NodeId id) : id_(id) {}

    // How nodes of that version want to be asked: 4 by broadcast, 5 to 7 for the whole, from 8 on
    // part by part.
    void start(Outbox& out, uint16_t protocol);
    void begin_turn(Outbox& out);
    void receive(Outbox& out, const wire::Description& header);
    template <typename Part>  // NamedVariable-, LocalEvent- or NativeFunctionDescription
    void receive(Outbox& out, const Part& part) {
        if (state_ == State::Asking && description_.begun()) take(out, description_.add(part));
    }
    // Another host asks for single parts: their order would mix with ours, so the whole is asked
    // for.
    void foreign_fragment(Outbox& out);
    // Too much in all: kDescriptionBytesTotalMax.
    void refuse(Outbox& out, std::string why);
    void tick(Outbox& out);

    State state() const { return state_; }
    Time next_tick() const { return deadline_; }           // while Asking
    Time part_at() const { return part_at_; }              // when a part came last
    size_t bytes() const { return description_.bytes(); }  // of the description so far
    aesl::Target give() { return description_.give(); }    // when Done
    const std::string& why() const { return why_; }

private:
    enum class Mode { Broadcast, Whole, Fragments };

    void ask(Outbox& out);
    void ask_fragment(Outbox& out);
    void take(Outbox& out, Progress progress);
    void fail(Outbox& out, std::string why);

    State state_ = State::Idle;
    Mode mode_ = Mode::Whole;
    NodeId id_;
    int tries_ = 0;  // since the last progress
    Time deadline_{};
    Time part_at_{};
    Description description_;
    std::string why_;
};

}  // namespace vagus::debug
