#include "run/real_time_parts.hpp"

#include <algorithm>

namespace vagus::run {

namespace {

constexpr Duration kFar = std::chrono::hours(24 * 365);  // longer waits are this long

}  // namespace

void RunClock::start() {
    const std::lock_guard lock(mutex_);
    start_ = SteadyClock::now();
}

void RunClock::halt() {
    const Time at = now();
    const std::lock_guard lock(mutex_);
    halted_at_ = at;
}

void RunClock::release() {
    const std::lock_guard lock(mutex_);
    start_ = SteadyClock::now() - *halted_at_;
    halted_at_.reset();
}

Time RunClock::now() const {
    const std::lock_guard lock(mutex_);
    if (halted_at_) return *halted_at_;
    return std::chrono::duration_cast<Duration>(SteadyClock::now() - start_);
}

SteadyClock::time_point RunClock::point_of(Time time) const {
    const std::lock_guard lock(mutex_);
    return start_ + std::min<Time>(time, 100 * kFar);
}

void LiveContext::linger(Duration time) {
    const auto end = SteadyClock::now() + std::clamp(time, Duration{0}, kFar);
    std::unique_lock lock(mutex_);
    wake_.wait_until(lock, end, [] { return false; });
}

void LiveContext::tell_to_stop() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
}

void LiveContext::hear(const BusEvent& event) {
    {
        const std::lock_guard lock(mutex_);
        if (!waiting_ || heard_ || (!event_.empty() && event_ != event.name)) return;
        heard_ = event;
    }
    wake_.notify_one();
}

void LiveContext::hold() {
    {
        const std::lock_guard lock(mutex_);
        held_ = true;
    }
    wake_.notify_one();
}

void LiveContext::release() {
    {
        const std::lock_guard lock(mutex_);
        held_ = false;
    }
    wake_.notify_one();
}

ActorContext::Woken LiveContext::wait(Duration at_most, std::string_view event) {
    // By the run's clock, which stands while the run is paused: what is left of a wait stays.
    const Time end = now() + std::clamp(at_most, Duration{0}, kFar);
    std::unique_lock lock(mutex_);
    event_ = std::string(event);
    waiting_ = true;
    heard_.reset();
    for (;;) {
        if (held_ && !stop_) stay_held(lock);
        const auto ready = [this] { return stop_ || held_ || heard_; };
        if (at_most == kNever) {
            wake_.wait(lock, ready);
        } else {
            wake_.wait_until(lock, clock_.point_of(end), ready);
        }
        if (stop_ || !held_) break;
    }
    waiting_ = false;
    return {.stop = stop_, .event = std::move(heard_)};
}

void LiveContext::stay_held(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    actor_.held();
    lock.lock();
    wake_.wait(lock, [this] { return stop_ || !held_; });
    if (stop_) return;
    lock.unlock();
    actor_.released();
    lock.lock();
}

}  // namespace vagus::run
