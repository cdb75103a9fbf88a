#include "run/real_time_parts.hpp"

#include "base/time.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vagus::run {

namespace {

constexpr Duration kFar = std::chrono::hours(24 * 365);  // longer waits are this long
// Two clocks are not read at the same moment; no computer sleeps shorter.
constexpr Duration kSleepMin = std::chrono::milliseconds(200);

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

// ---- sleep ----

SleepWatch::SleepWatch(const RunOptions& options) : slept_(options.slept) {
    if (!slept_ && options.on_emit) slept_ = slept_by_clocks;
    if (slept_) before_ = slept_();
}

bool SleepWatch::has_slept() {
    if (!slept_) return false;
    const Duration slept = slept_();
    const Duration more = slept - before_;
    if (more < kSleepMin) return false;
    before_ = slept;
    sentence_ = fmt::format(
        "the computer slept for {:.1f} s, and nobody watched the robot meanwhile; the plan has "
        "ended; look at the robot, then start the plan again",
        seconds_of(more));
    return true;
}

// ---- lateness ----

void LatenessSamples::note(Duration late) {
    const auto us = static_cast<uint32_t>(std::clamp<int64_t>(late.count(), 0, UINT32_MAX));
    if (us_.size() < kLatenessSamples) return us_.push_back(us);
    us_[next_] = us;
    next_ = (next_ + 1) % kLatenessSamples;
}

Lateness LatenessSamples::told() const {
    if (us_.empty()) return {};
    std::vector<uint32_t> us = us_;
    std::sort(us.begin(), us.end());
    const auto last = static_cast<double>(us.size() - 1);
    const auto at = [&](double share) { return Duration{us[static_cast<size_t>(share * last)]}; };
    return {us.size(), at(0.5), at(0.99), at(1.0)};
}

// ---- the inbox ----

namespace {

// From outside; what the plan itself emits is part of what it does.
bool can_be_held(const Message& message) {
    const auto* heard = std::get_if<Heard>(&message);
    return heard && !heard->own;
}

}  // namespace

void Inbox::post_locked(Message message) {
    messages_.push_back({++last_, std::move(message)});
}

void Inbox::put_locked(HeldEvent one) {
    const auto place =
        std::find_if(messages_.begin(), messages_.end(),
                     [&one](const Posted& posted) { return posted.number > one.number; });
    messages_.insert(place, {one.number, Heard{std::move(one.event), false}});
}

void Inbox::post(Message message) {
    {
        const std::lock_guard lock(mutex_);
        post_locked(std::move(message));
    }
    filled_.notify_one();
}

bool Inbox::post_bounded(Heard message) {
    {
        const std::lock_guard lock(mutex_);
        if (closed_at_) {
            const auto after =
                std::chrono::duration_cast<Duration>(SteadyClock::now() - *closed_at_);
            held_.add({++last_, after, std::move(message.event)});
            return true;
        }
        if (messages_.size() >= kInboxMax) return false;
        post_locked(std::move(message));
    }
    filled_.notify_one();
    return true;
}

std::deque<Posted> Inbox::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

void Inbox::give_back(std::deque<Posted> messages) {
    const std::lock_guard lock(mutex_);
    messages_.insert(messages_.begin(), std::move_iterator(messages.begin()),
                     std::move_iterator(messages.end()));
}

void Inbox::wait_until(std::optional<SteadyClock::time_point> until) {
    std::unique_lock lock(mutex_);
    const auto ready = [this] { return nudged_ || !messages_.empty(); };
    if (until) {
        filled_.wait_until(lock, *until, ready);
    } else {
        filled_.wait(lock, ready);
    }
    nudged_ = false;
}

void Inbox::nudge() {
    {
        const std::lock_guard lock(mutex_);
        nudged_ = true;
    }
    filled_.notify_one();
}

void Inbox::close_gate() {
    const std::lock_guard lock(mutex_);
    if (closed_at_) return;
    closed_at_ = SteadyClock::now();
    std::deque<Posted> others;
    for (Posted& posted : messages_) {
        if (can_be_held(posted.message)) {
            held_.add({posted.number, {}, std::move(std::get<Heard>(posted.message).event)});
        } else {
            others.push_back(std::move(posted));
        }
    }
    messages_ = std::move(others);
}

void Inbox::open_gate() {
    const std::lock_guard lock(mutex_);
    closed_at_.reset();
    std::deque<Posted> all;
    for (HeldEvent& one : held_.take_all()) {
        all.push_back({one.number, Heard{std::move(one.event), false}});
    }
    const auto before = [](const Posted& a, const Posted& b) { return a.number < b.number; };
    std::deque<Posted> messages = std::exchange(messages_, {});
    std::merge(std::move_iterator(messages.begin()), std::move_iterator(messages.end()),
               std::move_iterator(all.begin()), std::move_iterator(all.end()),
               std::back_inserter(messages_), before);
}

HeldNow Inbox::held() {
    const std::lock_guard lock(mutex_);
    return held_.now();
}

bool Inbox::let_go(uint64_t number) {
    const std::lock_guard lock(mutex_);
    auto one = held_.take(number);
    if (one) put_locked(std::move(*one));
    return one.has_value();
}

bool Inbox::drop(uint64_t number) {
    const std::lock_guard lock(mutex_);
    return held_.take(number).has_value();
}

// ---- what code waits on ----

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
        unheard_.push(event);
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

std::deque<BusEvent> LiveContext::take_unheard() {
    const std::lock_guard lock(mutex_);
    return unheard_.take_all();
}

void LiveContext::listen(std::vector<std::string> names) {
    const std::lock_guard lock(mutex_);
    kept_.listen(std::move(names));
    unheard_.clear();
}

// A wait has ended with that event: it and those before it are past. Without one, all are.
void LiveContext::pass(const std::optional<BusEvent>& taken) {
    if (!taken) return unheard_.clear();
    unheard_.pass(taken->name);
}

ActorContext::Woken LiveContext::wait(Duration at_most, std::string_view event) {
    std::unique_lock lock(mutex_);
    event_ = std::string(event);
    waiting_ = true;
    heard_ = early_.take(event);
    wait_for(lock, at_most, [this] { return heard_.has_value(); });
    waiting_ = false;
    pass(heard_);
    return noted({.stop = stop_, .event = std::move(heard_)});
}

ActorContext::Woken LiveContext::wait_kept(Duration at_most) {
    std::unique_lock lock(mutex_);
    if (told_) {
        const auto end = SteadyClock::now() + std::clamp(at_most, Duration{0}, kFar);
        wake_.wait_until(lock, end, [this] { return !kept_.empty(); });
        return noted({.stop = false, .event = kept_.take()});
    }
    wait_for(lock, at_most, [this] { return !kept_.empty(); });
    if (stop_) return {.stop = true};
    std::optional<BusEvent> first = kept_.take();
    pass(first);
    return noted({.stop = false, .event = std::move(first)});
}

// Until the time, `ready`, or Stop. By the run's clock, which is stopped while the run is paused:
// what is left of a wait stays.
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
