// Events that have come while code was between two waits. The next wait looks at them first, so
// that nothing is lost between a command and the wait for its answer, nor between the end of one
// actor and the begin of the next.
#pragma once

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "run/code.hpp"

namespace vagus::run {

class HeardEvents {
public:
    // Of more than kKeptEventsMax the oldest are lost.
    void push(const BusEvent& event) {
        if (events_.size() >= kKeptEventsMax) events_.pop_front();
        events_.push_back(event);
    }

    const std::deque<BusEvent>& all() const { return events_; }
    void clear() { events_.clear(); }
    std::deque<BusEvent> take_all() { return std::exchange(events_, {}); }

    // One has been heard elsewhere: those before it have been let pass, too. Nothing happens if it
    // is not among these.
    void pass(std::string_view name) {
        const auto found = std::ranges::find(events_, name, &BusEvent::name);
        if (found != events_.end()) events_.erase(events_.begin(), std::next(found));
    }

    // The first of that name (empty: of any). Those before it have been let pass; all have, if none
    // is of that name.
    std::optional<BusEvent> take(std::string_view name) {
        while (!events_.empty()) {
            BusEvent event = std::move(events_.front());
            events_.pop_front();
            if (name.empty() || name == event.name) return event;
        }
        return std::nullopt;
    }

private:
    std::deque<BusEvent> events_;
};

}  // namespace vagus::run
