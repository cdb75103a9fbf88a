#include "fleet/counters.hpp"

namespace vagus::fleet {

bool Numbers::is_new(const std::string& robot, int64_t epoch, int64_t number) {
    Seen& seen = seen_of({robot, epoch});
    if (!seen.numbers.insert(number).second) return false;
    seen.order.push_back(number);
    if (seen.order.size() <= kNumbersRemembered) return true;
    seen.numbers.erase(seen.order.front());
    seen.order.pop_front();
    return true;
}

Numbers::Seen& Numbers::seen_of(const Sender& sender) {
    const auto found = seen_.find(sender);
    if (found != seen_.end()) {
        used_.splice(used_.begin(), used_, found->second.place);
        return found->second;
    }
    if (seen_.size() >= kSendersRemembered) {
        seen_.erase(used_.back());
        used_.pop_back();
    }
    used_.push_front(sender);
    Seen& seen = seen_[sender];
    seen.place = used_.begin();
    return seen;
}

bool Rates::allows(const std::string& name, Time now) {
    // Names whose window is over say nothing any more.
    if (counts_.size() >= kRatesRemembered && !counts_.contains(name)) {
        std::erase_if(counts_, [&](const auto& one) { return now - one.second.since >= window_; });
        if (counts_.size() >= kRatesRemembered) return false;
    }
    Count& count = counts_[name];
    if (count.events == 0 || now - count.since >= window_) count = {now, 0};
    return ++count.events <= kEventsASecond * (window_ / 1s);
}

}  // namespace vagus::fleet
