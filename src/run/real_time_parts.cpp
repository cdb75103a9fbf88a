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
        const bool kept = kept_.offer(event);
        const bool waited_for = waiting_ && !heard_ && (event_.empty() || event_ == event.name);
        if (!waiting_ || heard_) early_.push(event);
        if (!kept && !waited_for) return;
        if (waited_for) heard_ = event;
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

void LiveContext::listen(std::vector<std::string> names) {
    const std::lock_guard lock(mutex_);
    kept_.listen(std::move(names));
}

ActorContext::Woken LiveContext::wait(Duration at_most, std::string_view event) {
    std::unique_lock lock(mutex_);
    event_ = std::string(event);
    waiting_ = true;
    heard_ = early_.take(event);
    wait_for(lock, at_most, [this] { return heard_.has_value(); });
    waiting_ = false;
    return {.stop = stop_, .event = std::move(heard_)};
}

ActorContext::Woken LiveContext::wait_kept(Duration at_most) {
    std::unique_lock lock(mutex_);
    if (told_) {
        const auto end = SteadyClock::now() + std::clamp(at_most, Duration{0}, kFar);
        wake_.wait_until(lock, end, [this] { return !kept_.empty(); });
        return {.stop = false, .event = kept_.take()};
    }
    wait_for(lock, at_most, [this] { return !kept_.empty(); });
    if (stop_) return {.stop = true};
    return {.stop = false, .event = kept_.take()};
}

// Until the time, `ready`, or Stop. By the run's clock, which stands while the run is paused: what
// is left of a wait stays.
void LiveContext::wait_for(std::unique_lock<std::mutex>& lock, Duration at_most,
                           const std::function<bool()>& ready) {
    const Time end = clock_.now() + std::clamp(at_most, Duration{0}, kFar);
    for (;;) {
        if (held_ && !stop_) stay_held(lock);
        const auto wakes = [this, &ready] { return stop_ || held_ || ready(); };
        if (at_most == kNever) {
            wake_.wait(lock, wakes);
        } else {
            wake_.wait_until(lock, clock_.point_of(end), wakes);
        }
        if (stop_ || !held_) return;
    }
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
