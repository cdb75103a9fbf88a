// VirtualTime: what a debugger does with events of the bus while it holds the run.
#include <iterator>
#include <utility>

#include "run/surroundings.hpp"
#include "run/virtual_time.hpp"

namespace vagus::run {

// What of it is heard now: all, unless a debugger holds it; what it has let go comes first.
std::vector<BusEvent> VirtualTime::pass(std::vector<BusEvent> arrived) {
    std::vector<BusEvent> heard = std::exchange(passing_, {});
    if (gate_closed_) {
        hold(std::move(arrived));
    } else {
        std::move(arrived.begin(), arrived.end(), std::back_inserter(heard));
    }
    return heard;
}

void VirtualTime::hold(std::vector<BusEvent> arrived) {
    for (BusEvent& event : arrived) {
        held_.add({.number = ++last_held_, .after = {}, .event = std::move(event)});
    }
}

void VirtualTime::close_gate() {
    gate_closed_ = true;
}

void VirtualTime::open_gate() {
    gate_closed_ = false;
    for (HeldEvent& one : held_.take_all()) passing_.push_back(std::move(one.event));
}

// The clock is stopped, and yet something may have arrived: from nodes at this instant, from others
// on the bus since.
HeldNow VirtualTime::held() {
    if (gate_closed_ && options_.surroundings) hold(options_.surroundings->arrived());
    return held_.now();
}

bool VirtualTime::let_go(uint64_t number) {
    auto one = held_.take(number);
    if (one) passing_.push_back(std::move(one->event));
    return one.has_value();
}

}  // namespace vagus::run
