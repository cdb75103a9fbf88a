// Events of the bus that an actor's code has asked for, until it takes them.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "run/code.hpp"

namespace vagus::run {

class KeptEvents {
public:
    // What was kept before is dropped.
    void listen(std::vector<std::string> names) {
        names_ = std::move(names);
        events_.clear();
        overrun_ = false;
    }

    // Whether the event was one of those; it is kept then.
    bool offer(const BusEvent& event) {
        if (std::find(names_.begin(), names_.end(), event.name) == names_.end()) return false;
        overrun_ = overrun_ || events_.size() == kKeptEventsMax;
        if (!overrun_) events_.push_back(event);
        return true;
    }

    // The first; throws CodeError when one has been lost, for the code could not know of it.
    std::optional<BusEvent> take() {
        if (overrun_) {
            throw CodeError("more than " + std::to_string(kKeptEventsMax) +
                            " events came before it took them; let the node send fewer");
        }
        if (events_.empty()) return std::nullopt;
        BusEvent first = std::move(events_.front());
        events_.pop_front();
        return first;
    }

    bool empty() const { return events_.empty() && !overrun_; }

private:
    std::vector<std::string> names_;
    std::deque<BusEvent> events_;
    bool overrun_ = false;
};

}  // namespace vagus::run
