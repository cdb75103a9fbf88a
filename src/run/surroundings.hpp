// What has time of its own beside a plan in virtual time: a world with its nodes and its bus. Both
// share one clock. At one instant (docs/ARCHITECTURE.md): the timeline, deliveries of the bus,
// nodes by id; then the plan, in the order of P21; then the bodies.
//
//     class Metronome : public Surroundings {
//         Time next() const override { return next_; }
//         std::vector<BusEvent> begin() override { next_ += 1s; return {{"tick", {}}}; }
//         void emit(Time, const BusEvent&) override {}
//         void end() override {}
//         Time next_{};
//     } metronome;
//     options.surroundings = &metronome;               // then VirtualTime
//
// All calls come on the deciding thread: next() and late() at any time; begin() when the run has
// come to that instant; then what the plan does at it and emits; then end(), before the clock moves
// on or the run is over.
#pragma once

#include <vector>

#include "base/time.hpp"
#include "run/code.hpp"

namespace vagus::run {

class Surroundings {
public:
    virtual ~Surroundings() = default;

    // The next instant that begin() has not been called for; each is later than the one before.
    virtual Time next() const = 0;
    // Something else of the run is due then: when it is taken, then or later.
    virtual Time late(Time due) { return due; }
    // Does what comes before the plan at the instant next(); gives what the plan hears at it.
    virtual std::vector<BusEvent> begin() = 0;
    // While a debugger holds the run, between begin() and end(): what has arrived meanwhile, which
    // begin() then does not give any more.
    virtual std::vector<BusEvent> arrived() { return {}; }
    // The plan emits; `at` may lie between two instants.
    virtual void emit(Time at, const BusEvent& event) = 0;
    // Does what comes after the plan at the instant that was begun last.
    virtual void end() = 0;
};

}  // namespace vagus::run
