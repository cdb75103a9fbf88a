// Events of the bus that wait while a plan is paused: in the order in which they came, until each
// is let go or dropped, or all go because the plan goes on.
//
//     HeldEvents held;
//     held.add({.number = 1, .event = {"touch", {3}, 2}});
//     if (auto one = held.take(1)) hear(one->event);
//     if (held.now().dropped > 0) …                // more came than there was room for
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "run/code.hpp"

namespace vagus::run {

// Of more than these the newest are dropped: what came first is what a person steps through first.
constexpr size_t kHeldEventsMax = 1000;

struct HeldEvent {
    uint64_t number = 0;  // never used twice in a run
    Duration after{};     // in real time: so long after the plan paused
    BusEvent event = {};
};

struct HeldNow {
    std::vector<HeldEvent> events = {};
    uint64_t dropped = 0;  // for want of room, since the plan paused
};

class HeldEvents {
public:
    void add(HeldEvent one);
    // Nothing if no such event waits.
    std::optional<HeldEvent> take(uint64_t number);
    // The plan goes on; what was dropped is counted again.
    std::deque<HeldEvent> take_all() {
        dropped_ = 0;
        return std::exchange(events_, {});
    }
    HeldNow now() const { return {{events_.begin(), events_.end()}, dropped_}; }

private:
    std::deque<HeldEvent> events_;
    uint64_t dropped_ = 0;
};

// The door through which a run hears its bus, as a debugger uses it while the run is paused; on the
// deciding thread. An executor implements it.
class EventGate {
public:
    virtual ~EventGate() = default;

    // From here on what comes waits. Closed already: nothing changes.
    virtual void close_gate() = 0;
    // What waits goes to the plan, in its order, before anything that comes later.
    virtual void open_gate() = 0;
    virtual HeldNow held() = 0;
    // That one goes to the plan as soon as it continues, or is dropped. False if it does not wait.
    virtual bool let_go(uint64_t number) = 0;
    virtual bool drop(uint64_t number) = 0;
};

}  // namespace vagus::run
