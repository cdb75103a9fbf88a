#include "run/held_events.hpp"

#include <algorithm>
#include <utility>

namespace vagus::run {

void HeldEvents::add(HeldEvent one) {
    if (events_.size() >= kHeldEventsMax) {
        ++dropped_;
    } else {
        events_.push_back(std::move(one));
    }
}

std::optional<HeldEvent> HeldEvents::take(uint64_t number) {
    const auto found = std::find_if(events_.begin(), events_.end(), [number](const HeldEvent& one) {
        return one.number == number;
    });
    if (found == events_.end()) return std::nullopt;
    HeldEvent one = std::move(*found);
    events_.erase(found);
    return one;
}

}  // namespace vagus::run
