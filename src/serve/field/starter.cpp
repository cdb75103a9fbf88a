#include "serve/field/starter.hpp"

#include <fmt/format.h>

namespace vagus::serve {

namespace {

std::string waits_for(const std::vector<std::string>& missing) {
    std::string names;
    for (const std::string& name : missing) names += (names.empty() ? "" : ", ") + name;
    return "waiting for nodes that are not there yet: " + names;
}

}  // namespace

void Starter::begin(Time now) {
    ++attempt_;
    state_ = State::Waiting;
    why_ = "it has not begun yet";
    refused_.clear();
    told_.clear();
    next_ = now_ = now;
}

void Starter::give_up() {
    ++attempt_;
    state_ = State::Idle;
    why_ = "it was stopped";
    refused_.clear();
}

void Starter::died(Time now) {
    if (state_ != State::Started) return;
    now_ = now;
    deaths_.push_back(now);
    while (now - deaths_.front() > kDeathsWithin) deaths_.pop_front();
    if (deaths_.size() < kDeathsMax) {
        told_.clear();
        return wait("warning", "its run died; it starts again", now + kStartAgainAfter);
    }
    deaths_.clear();
    state_ = State::Idle;
    why_ = fmt::format("its run died {} times within {} s; it is stopped until somebody starts it",
                       kDeathsMax, kDeathsWithin / 1s);
    call_.log("error", why_);
}

void Starter::failed(const std::string& why) {
    if (state_ != State::Started) return;
    state_ = State::Failed;
    why_ = "its plan ended in an error: " + why;
}

void Starter::wait(const std::string& kind, const std::string& why, Time until) {
    state_ = State::Waiting;
    why_ = why;
    next_ = until;
    if (why == told_) return;
    told_ = why;
    call_.log(kind, why);
}

void Starter::tick(Time now) {
    now_ = now;
    if (state_ != State::Waiting || now < next_) return;
    const std::vector<std::string> missing = call_.missing();
    if (!missing.empty()) return wait("note", waits_for(missing), now + kLookForNodesEvery);
    state_ = State::Starting;
    call_.start([this, attempt = ++attempt_](const std::string& why) {
        if (attempt != attempt_) return;
        if (!why.empty()) {
            refused_ = "it does not start: " + why;
            return wait("error", refused_, now_ + kStartAgainAfter);
        }
        state_ = State::Started;
        why_.clear();
        refused_.clear();
    });
}

Time Starter::next_tick() const {
    return state_ == State::Waiting ? next_ : Time::max();
}

}  // namespace vagus::serve
