#include "fleet/outbox.hpp"

#include <algorithm>

#include "fleet/limits.hpp"

namespace vagus::fleet {

void Outbox::add(Post post, Time now) {
    if (waiting_.size() >= kOutboxMax) {
        waiting_.pop_front();
        sent_ -= std::min<size_t>(sent_, 1);
        ++dropped_;
    }
    post.number = ++numbers_;
    waiting_.push_back({std::move(post), now});
}

std::vector<Post> Outbox::take_due(Time now) {
    drop_old(now);
    std::vector<Post> due;
    while (sent_ < std::min(waiting_.size(), kInFlightMax)) {
        due.push_back(waiting_[sent_++].post);
    }
    return due;
}

void Outbox::drop_old(Time now) {
    while (!waiting_.empty() && now - waiting_.front().since > kEventAgeMax) {
        waiting_.pop_front();
        sent_ -= std::min<size_t>(sent_, 1);
        ++dropped_;
    }
}

void Outbox::acknowledged(uint64_t number) {
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(sent_);
    const auto found = std::find_if(
        waiting_.begin(), end, [number](const Waiting& one) { return one.post.number == number; });
    if (found == end) return;
    waiting_.erase(found);
    --sent_;
}

void Outbox::link_lost() {
    sent_ = 0;
}

}  // namespace vagus::fleet
