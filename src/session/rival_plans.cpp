#include "session/rival_plans.hpp"

#include <algorithm>

namespace vagus::session {

namespace {

uint16_t token_in(const run::BusEvent& event) {
    return static_cast<uint16_t>(event.arguments.front()) & run::kTokenMax;
}

// Tokens count on in a ring, from the highest to the lowest.
uint16_t steps_from(uint16_t from, uint16_t to) {
    return static_cast<uint16_t>(to - from) & run::kTokenMax;
}

bool near(uint16_t a, uint16_t b) {
    return std::min(steps_from(a, b), steps_from(b, a)) < kNearTokens;
}

}  // namespace

uint16_t RivalPlans::random_token() {
    last_token_ = static_cast<uint16_t>(1 + random_.below(run::kTokenMax));
    return last_token_;
}

bool RivalPlans::is_start(const run::BusEvent& event) const {
    return !event.arguments.empty() && starts_.contains(event.name);
}

void RivalPlans::said(const run::BusEvent& event) {
    if (!is_start(event)) return;
    if (own_.size() >= kOwnStartsKept) own_.pop_front();
    own_.push_back(event);
    last_token_ = token_in(event);
}

std::optional<RivalPlans::Rival> RivalPlans::hear(const run::BusEvent& event) {
    if (!is_start(event)) return std::nullopt;
    const auto own = std::find_if(own_.begin(), own_.end(), [&event](const run::BusEvent& one) {
        return one.name == event.name && one.arguments == event.arguments;
    });
    if (own != own_.end()) {
        own_.erase(own);
        return std::nullopt;
    }
    Rival rival{.is_news = !std::exchange(told_, true)};
    const uint16_t theirs = token_in(event);
    if (!rival.is_news && !near(theirs, last_token_)) return rival;
    // Anywhere but near theirs. At random: the other plan moves too.
    do {
        rival.move_to = random_token();
    } while (near(theirs, *rival.move_to));
    return rival;
}

}  // namespace vagus::session
