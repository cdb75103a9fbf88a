// The parts of RealTime that its threads share: the run's clock, the inbox of the deciding thread,
// and what an actor's code waits on. Only its own source, real_time.cpp, and real_time_watch.hpp,
// which is a part of that, include this.
#pragma once

#include <time.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "run/code.hpp"
#include "run/heard_events.hpp"
#include "run/held_events.hpp"
#include "run/kept_events.hpp"
#include "run/options.hpp"
#include "run/real_time.hpp"

namespace vagus::run {

using SteadyClock = std::chrono::steady_clock;

constexpr size_t kInboxMax = 65'536;  // events from outside beyond this are dropped and counted

// Time since the start of the run, without its pauses. Read from any thread; started, halted and
// released by the deciding one.
class RunClock {
public:
    void start();
    // The clock is stopped from here to release().
    void halt();
    void release();
    Time now() const;
    SteadyClock::time_point point_of(Time time) const;

private:
    mutable std::mutex mutex_;            // over the two: a time is read of both at once
    SteadyClock::time_point start_{};     // where a run without pauses would have started
    std::optional<Time> halted_at_ = {};  // the time at which it is paused
};

inline Duration read_clock(clockid_t clock) {
    timespec time{};
    ::clock_gettime(clock, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_nsec / 1000);
}

// Since the computer was started: the one clock goes on while it sleeps, the other does not.
inline Duration slept_by_clocks() {
    const Duration awake = read_clock(CLOCK_MONOTONIC);
    return read_clock(CLOCK_BOOTTIME) - awake;
}

// How late checks began, of the last kLatenessSamples.
class LatenessSamples {
public:
    void note(Duration late);
    Lateness told() const;

private:
    std::vector<uint32_t> us_;
    size_t next_ = 0;
};

// Notices that the computer has slept. A plan that wakes does not know what its robot has done
// meanwhile, and may not go on as if nothing had been.
class SleepWatch {
public:
    explicit SleepWatch(const RunOptions& options);
    // Has it slept since this was last asked?
    bool has_slept();
    // How long, as a sentence; empty if it never has.
    const std::string& sentence() const { return sentence_; }

private:
    std::function<Duration()> slept_;  // empty: nobody asks
    Duration before_{};
    std::string sentence_;
};

// ---- what other threads tell the deciding one ----

struct CodeOver {  // run() has returned or thrown
    plan::ActivationId activation;
    plan::Given given;
    bool failed;
    std::string failure;
};
struct Checked {
    plan::WatchId watch;
    std::optional<plan::Given> given;
    bool failed;
    std::string failure;
    Duration late;  // from the deadline to the begin of the check
};
struct Logged {
    plan::ActivationId activation;
    std::string text;
};
struct Heard {
    BusEvent event;
    bool own;  // emitted by the plan itself
};
struct Written {
    int slot;
    plan::Value value;
};
struct Aborted {};
struct RunFailed {  // see Machine::fail_run()
    std::string why;
};
struct TokensMoved {  // see Numbers::move_to()
    uint16_t token;
};
using Message =
    std::variant<CodeOver, Checked, Logged, Heard, Written, Aborted, RunFailed, TokensMoved>;

// Numbers tell in which order messages came, also those that were held meanwhile.
struct Posted {
    uint64_t number;
    Message message;
};

// The one door to the deciding thread. While its gate is closed, events from outside wait in it.
class Inbox {
public:
    void post(Message message);
    // Events from outside are bounded: a flood of them must not fill the memory.
    bool post_bounded(Heard message);

    std::deque<Posted> take();
    // What was taken and not looked at.
    void give_back(std::deque<Posted> messages);
    void wait_until(std::optional<SteadyClock::time_point> until);
    // Ends the wait although there is no message: a debugger asks.
    void nudge();

    // ---- while a debugger holds the run, on the deciding thread; as EventGate ----
    void close_gate();
    void open_gate();
    HeldNow held();
    bool let_go(uint64_t number);
    bool drop(uint64_t number);

private:
    void post_locked(Message message);
    // Behind those that came before it, however late it is put.
    void put_locked(HeldEvent one);

    std::mutex mutex_;  // guards what follows
    std::condition_variable filled_;
    std::deque<Posted> messages_;
    uint64_t last_ = 0;
    bool nudged_ = false;
    std::optional<SteadyClock::time_point> closed_at_;
    HeldEvents held_;
};

// What also a check reaches that nobody waits for any more. Owners: the run, and each check.
struct Doors {
    Inbox inbox;
    RunClock clock;
};

// One running of an actor's code. While the run is paused its waits hold it (decision 0090).
class LiveContext final : public ActorContext {
public:
    struct Of {  // which running of which code this is
        plan::ActivationId activation;
        uint64_t number;
        Actor& actor;
        size_t outputs;
        const RunOptions& options;
        std::string_view name;  // of the element
    };
    LiveContext(std::vector<plan::Value> in, const Of& of, Inbox& inbox, SplitMix64& random,
                const RunClock& clock)
        : ActorContext(std::move(in), of.outputs, of.number),
          activation_(of.activation),
          actor_(of.actor),
          options_(of.options),
          name_(of.name),
          inbox_(inbox),
          random_(random),
          clock_(clock) {}

    // ---- for the code ----
    Time now() const override { return clock_.now(); }
    void linger(Duration time) override;
    void log(std::string text) override { inbox_.post(Logged{activation_, std::move(text)}); }
    void emit(BusEvent event) override {
        throw_if_refused(options_, event);
        event.by = name_;
        event.cause = heard_frame_;
        inbox_.post(Heard{std::move(event), true});
    }
    // The generator of a run, drawn from by one actor at a time (P14).
    SplitMix64& random() override { return random_; }
    void listen(std::vector<std::string> names) override;

    // ---- for the deciding thread ----
    void tell_to_stop();
    void hear(const BusEvent& event);
    void hold();
    void release();
    // When its code is over: what came after its last wait, in that order.
    std::deque<BusEvent> take_unheard();

protected:
    Woken wait(Duration at_most, std::string_view event) override;
    Woken wait_kept(Duration at_most) override;

private:
    // What the code is given, in its thread.
    Woken noted(Woken woken) {
        if (woken.event) heard_frame_ = woken.event->frame;
        return woken;
    }
    void wait_for(std::unique_lock<std::mutex>& lock, Duration at_most,
                  const std::function<bool()>& ready);
    void pass(const std::optional<BusEvent>& taken);
    void stay_held(std::unique_lock<std::mutex>& lock);

    const plan::ActivationId activation_;
    Actor& actor_;
    const RunOptions& options_;
    const std::string_view name_;
    Inbox& inbox_;
    SplitMix64& random_;
    const RunClock& clock_;
    uint32_t heard_frame_ = 0;  // number of the frame that the code heard last; its thread's
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stop_ = false;
    bool held_ = false;
    bool waiting_ = false;
    HeardEvents early_;    // while it did not wait
    HeardEvents unheard_;  // since its last wait ended
    std::string event_;
    std::optional<BusEvent> heard_;
    KeptEvents kept_;
};

}  // namespace vagus::run
