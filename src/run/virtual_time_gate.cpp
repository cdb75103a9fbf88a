// VirtualTime: what a debugger does with events of the bus while it holds the run; what it asks.
#include <iterator>
#include <utility>

#include "base/text.hpp"
#include "run/debug_view.hpp"
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

Status VirtualTime::do_as_asked(const Request& request) {
    if (machine_.depth() == 0 || over()) {
        return Error{vagus::Code::Unavailable, "no plan runs"};
    }
    if (const auto* const set = std::get_if<SetVariable>(&request)) {
        const int slot = TRY(find_variable(machine_, set->level, set->name));
        TRY(machine_.write_outside(set->level, slot, set->value, now_));
    } else if (const auto* const raise = std::get_if<RaiseEvent>(&request)) {
        const Raised raised =
            TRY(find_raised(machine_, raise->supervisor, raise->event, raise->outputs));
        machine_.raise(raised.watch, raised.given, now_);
    } else if (std::holds_alternative<Abort>(request)) {
        machine_.abort(now_);
    } else if (const auto* const version = std::get_if<TakeVersion>(&request)) {
        const std::vector<std::string> reasons = machine_.change(version->next, now_);
        if (!reasons.empty()) return Error{vagus::Code::Refused, joined_lines(reasons)};
    } else {
        return Error{vagus::Code::Refused, "a run in virtual time does not do that by itself"};
    }
    obey();
    return Status::done();
}

}  // namespace vagus::run
