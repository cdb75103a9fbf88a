// A supervisor's running check when what it watched over ends (docs/plans.md, P18b). How long it is
// waited for is injected: hours where it returns, a millisecond where it hangs.
#include "run/real_time.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include "run/test_plans.hpp"

namespace vagus::run {
namespace {

using namespace std::chrono_literals;

// Shared with threads that may outlive the run.
struct Hanging {
    std::mutex mutex;
    std::condition_variable changed;
    bool released = false;
    int alive = 0;  // supervisors
    std::atomic<int> checks = 0;
    std::atomic<bool> inside = false;  // the second check, which hangs
    std::atomic<int> at_once = 0;
    std::atomic<int> most_at_once = 0;
    std::atomic<int> stopped = 0;
    std::atomic<int> stopped_beside_a_check = 0;

    void release() {
        const std::lock_guard lock(mutex);
        released = true;
        changed.notify_all();
    }
    void wait_until_gone() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return alive == 0; });
    }
    void count(int by) {
        const std::lock_guard lock(mutex);
        alive += by;
        changed.notify_all();
    }
};

// Its second check of all hangs until it is released, and then raises its event.
class Hangs final : public Supervisor {
public:
    explicit Hangs(std::shared_ptr<Hanging> hanging) : hanging_(std::move(hanging)) {
        hanging_->count(1);
    }
    ~Hangs() override { hanging_->count(-1); }

    std::optional<plan::Given> check(const Check&) override {
        Hanging& all = *hanging_;
        const int now = ++all.at_once;
        all.most_at_once = std::max(all.most_at_once.load(), now);
        std::optional<plan::Given> given;
        if (++all.checks == 2) {
            all.inside = true;
            std::unique_lock lock(all.mutex);
            all.changed.wait(lock, [&all] { return all.released; });
            given = plan::Given{};
        }
        --all.at_once;
        return given;
    }
    void stopped(SupervisorContext&) noexcept override {
        ++hanging_->stopped;
        if (hanging_->at_once > 0) ++hanging_->stopped_beside_a_check;
    }

private:
    std::shared_ptr<Hanging> hanging_;  // owners: the test and all of these
};

// Calls a function at each check, each millisecond.
class Beats final : public Supervisor {
public:
    explicit Beats(std::function<void()> beat) : beat_(std::move(beat)) {}
    std::optional<plan::Given> check(const Check&) override {
        beat_();
        return std::nullopt;
    }

private:
    std::function<void()> beat_;
};

class RealTimeChecks : public testing::Test {
protected:
    void SetUp() override {
        library_.add(
            "core", "",
            {test_actor("UntilItHangs",
                        [hanging = hanging_](ActorContext& context) {
                            context.wait_until([&] { return hanging->inside.load(); }, 1ms);
                            context.end(0);
                        }),
             test_actor("AtOnce", [](ActorContext& context) { context.end(0); }), twice(),
             test_supervisor("Hangs", 1,
                             [hanging = hanging_] { return std::make_unique<Hangs>(hanging); }),
             test_supervisor("Beats", 1,
                             [this] { return std::make_unique<Beats>([this] { beat(); }); })});
        options_.max_time = 10min;
        options_.on_trace = [this](const plan::TraceEvent& event) {
            // Before that, and of others, it is the machine's load that makes checks late.
            const auto* late = std::get_if<plan::CheckLate>(&event.what);
            if (late && (late->supervisor != "slow" || !hanging_->inside)) return;
            const std::lock_guard lock(mutex_);
            lines_.push_back(test_line(event));
        };
    }
    void TearDown() override {
        hanging_->release();
        hanging_->wait_until_gone();
    }

    // Ends in its first state, and then in its second one.
    static Coded twice() {
        Coded coded = test_actor("Twice", [n = std::make_shared<int>(0)](ActorContext& context) {
            context.end((*n)++ == 0 ? 0 : 1);
        });
        coded.declared.outcomes = {{.name = "First"}, {.name = "Second"}};
        return coded;
    }

    // On threads of checks. Releases the check when the last line has stood for some beats: long
    // enough for what must not happen meanwhile.
    void beat() {
        const std::lock_guard lock(mutex_);
        const bool stands = !lines_.empty() && lines_.back() == release_after_;
        beats_ = stands ? beats_ + 1 : 0;
        if (beats_ == 20) hanging_->release();
    }

    Ended run(const std::string& text) {
        const plan::Graph graph = test_graph(text, library_);
        return RealTime(graph, library_, options_).run();
    }

    std::shared_ptr<Hanging> hanging_ = std::make_shared<Hanging>();
    CodeLibrary library_;
    RunOptions options_;
    std::string release_after_;
    std::mutex mutex_;  // guards what follows
    std::vector<std::string> lines_;
    int beats_ = 0;
};

constexpr std::string_view kTwo = R"({ "format": "vagus-plan/1", "name": "P",
  "start": { "actor": "a", "supervisors": { "beats": { "template": "Beats",
                                                       "events": { "Seen": "@terminate" } } } },
  "actors": {
    "a": { "template": "UntilItHangs", "states": { "Done": "b" },
           "supervisors": { "slow": { "template": "Hangs", "events": { "Seen": "@terminate" } } } },
    "b": { "template": "AtOnce", "states": { "Done": "@terminate" } } } })";

// The check is released only after the end of `a` has stood for 20 ms: had the plan not waited, `b`
// would have started before. The global supervisor goes on meanwhile.
TEST_F(RealTimeChecks, WhatComesNextWaitsForACheckThatReturns) {
    options_.check_ends_within = 10min;
    release_after_ = "actor-end a";
    const Ended ended = run(std::string(kTwo));
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
    EXPECT_THAT(lines_, testing::ElementsAre("plan-start", "actor-start a", "actor-end a",
                                             "actor-start b", "actor-end b", "plan-end"));
    EXPECT_EQ(hanging_->stopped, 1);
    EXPECT_EQ(hanging_->stopped_beside_a_check, 0);
}

TEST_F(RealTimeChecks, ACheckThatHangsIsToldAndLeftToItself) {
    options_.check_ends_within = 1ms;
    const Ended ended = run(std::string(kTwo));  // returns, although nobody has released it
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
    EXPECT_THAT(lines_,
                testing::ElementsAre("plan-start", "actor-start a", "actor-end a", "late slow",
                                     "actor-start b", "actor-end b", "plan-end"));
    EXPECT_EQ(hanging_->stopped, 0);
}

TEST_F(RealTimeChecks, TheLineOfThePlansEndIsTheLastAlsoWhereAGlobalOneHangs) {
    options_.check_ends_within = 1ms;
    const Ended ended = run(R"({ "format": "vagus-plan/1", "name": "P",
      "start": { "actor": "a", "supervisors": { "slow": { "template": "Hangs",
                                                          "events": { "Seen": "@ignore" } } } },
      "actors": { "a": { "template": "UntilItHangs", "states": { "Done": "@terminate" } } } })");
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
    EXPECT_THAT(lines_, testing::ElementsAre("plan-start", "actor-start a", "actor-end a",
                                             "late slow", "plan-end"));
}

// `a` comes again while the check hangs that it was left with: its supervisor's first check, and so
// its begin (P16), wait for that. What the old check gives is dropped.
TEST_F(RealTimeChecks, NoTwoChecksOfOneSupervisorRunAtOnce) {
    options_.check_ends_within = 1ms;
    release_after_ = "actor-end again";
    const Ended ended = run(R"({ "format": "vagus-plan/1", "name": "P",
      "start": { "actor": "a", "supervisors": { "beats": { "template": "Beats",
                                                           "events": { "Seen": "@ignore" } } } },
      "actors": {
        "a": { "template": "UntilItHangs", "states": { "Done": "again" },
               "supervisors": { "slow": { "template": "Hangs", "events": { "Seen": "b" } } } },
        "again": { "template": "Twice", "states": { "First": "a", "Second": "@terminate" } },
        "b": { "template": "AtOnce", "states": { "Done": "@terminate" } } } })");
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
    // The first check of the second watching begins late, and is over late: two lines.
    lines_.erase(std::unique(lines_.begin(), lines_.end()), lines_.end());
    EXPECT_THAT(lines_, testing::ElementsAre("plan-start", "actor-start a", "actor-end a",
                                             "late slow", "actor-start again", "actor-end again",
                                             "late slow", "actor-start a", "actor-end a",
                                             "actor-start again", "actor-end again", "plan-end"));
    EXPECT_EQ(hanging_->most_at_once, 1);
    EXPECT_EQ(hanging_->stopped, 2);  // both watchings: the old one when its check had returned
    EXPECT_EQ(hanging_->stopped_beside_a_check, 0);
}

// ---- a computer that sleeps ----

constexpr std::string_view kEndless = R"({ "format": "vagus-plan/1", "name": "P",
  "start": { "actor": "a", "supervisors": { "beats": { "template": "Beats",
                                                       "events": { "Seen": "@ignore" } } } },
  "actors": { "a": { "template": "UntilItHangs", "states": { "Done": "@terminate" } } } })";

TEST_F(RealTimeChecks, AComputerThatSleptEndsThePlanWhenItWakes) {
    Duration slept = 5s;  // before the run: that is no matter
    options_.slept = [&slept] { return slept; };
    options_.on_trace = [&slept, note = options_.on_trace](const plan::TraceEvent& event) {
        note(event);
        if (test_line(event) == "actor-start a") slept += 12300ms;
    };
    const Ended ended = run(std::string(kEndless));
    EXPECT_EQ(ended.result, plan::PlanResult::Interrupted);
    EXPECT_THAT(ended.message, testing::HasSubstr("the computer slept for 12.3 s"));
    EXPECT_EQ(lines_.back(), "plan-end");
}

// What it works on is lost: told from outside, on whatever thread.
TEST_F(RealTimeChecks, ARunThatIsToldThatItCannotGoOnStopsItsCodeAndEndsWithAnError) {
    RealTime* running = nullptr;
    bool told = false;
    library_.add("more", "", {test_actor("Endless", [&](ActorContext& context) {
                     running->fail("the robot is lost");
                     try {
                         context.sleep(1h);
                     } catch (const Stop&) {
                         told = true;
                         throw;
                     }
                 })});
    const plan::Graph graph = test_graph(R"({ "format": "vagus-plan/1", "name": "P",
        "toolboxes": ["more"], "start": { "actor": "a" },
        "actors": { "a": { "template": "Endless", "states": { "Done": "@terminate" } } } })",
                                         library_);
    RealTime run(graph, library_, options_);
    running = &run;
    const Ended ended = run.run();
    EXPECT_EQ(ended.result, plan::PlanResult::Error);
    EXPECT_EQ(ended.message, "P: a: the robot is lost");
    EXPECT_TRUE(told);
    EXPECT_THAT(lines_, testing::ElementsAre("plan-start", "actor-start a", "error a",
                                             "interrupted a", "plan-end"));
}

// The two clocks are not read at the same moment.
TEST_F(RealTimeChecks, ClocksThatDifferALittleAreNoSleep) {
    options_.max_time = 50ms;
    options_.slept = [by = 0ms]() mutable { return by = by == 0ms ? 100ms : 0ms; };
    const Ended ended = run(std::string(kEndless));
    EXPECT_TRUE(ended.timed_out);
    EXPECT_EQ(ended.message, "");
}

// ---- an answer that is faster than the run ----

// Sends, and returns when the run has taken the answer: nobody else waits for it yet.
class FastAnswers : public testing::Test {
protected:
    FastAnswers() {
        library_.add(
            "core", "",
            {test_actor("Ask",
                        [this](ActorContext& context) {
                            context.emit({"ask", {}});
                            std::unique_lock lock(mutex_);
                            came_.wait(lock, [this] { return answers_taken_ == answers_; });
                        }),
             test_actor("Nothing", [](ActorContext&) {}),
             test_actor("Sleep", [](ActorContext& context) { context.sleep(1h); }),
             test_actor("Await", [](ActorContext& context) { context.wait_event("answer"); }),
             test_actor("AwaitBriefly",
                        [](ActorContext& context) {
                            if (context.wait_event("answer", 50ms)) throw CodeError("heard twice");
                        }),
             test_supervisor("OnAnswer", 0, [] { return std::make_unique<OnAnswer>(); })});
        options_.max_time = 30s;
        options_.on_emit = [this](const BusEvent&) {
            for (int i = 0; i < answers_; ++i) running_->hear({"answer", {}});
        };
        options_.on_hear = [this](const BusEvent&, Time) {
            const std::lock_guard lock(mutex_);
            ++answers_taken_;
            came_.notify_all();
        };
        options_.on_trace = [this](const plan::TraceEvent& event) {
            lines_.push_back(test_line(event));
        };
    }

    class OnAnswer final : public Supervisor {
        std::optional<plan::Given> check(const Check& check) override {
            if (!check.event || check.event->name != "answer") return std::nullopt;
            return plan::Given{};
        }
    };

    Ended run(const std::string& actors) {
        const plan::Graph graph = test_graph(
            R"({ "format": "vagus-plan/1", "name": "P", "start": { "actor": "ask" }, "actors": {)" +
                actors + "} }",
            library_);
        RealTime run(graph, library_, options_);
        running_ = &run;
        return run.run();
    }

    CodeLibrary library_;
    RunOptions options_;
    RealTime* running_ = nullptr;
    int answers_ = 1;
    std::mutex mutex_;  // guards what follows
    std::condition_variable came_;
    int answers_taken_ = 0;
    std::vector<std::string> lines_;
};

TEST_F(FastAnswers, TheNextActorHearsWhatCameAsTheOneBeforeEnded) {
    const Ended ended = run(R"("ask": { "template": "Ask", "states": { "Done": "between" } },
        "between": { "template": "Nothing", "states": { "Done": "await" } },
        "await": { "template": "Await", "states": { "Done": "@terminate" } })");
    EXPECT_EQ(ended.result, plan::PlanResult::Ok) << ended.message;
    EXPECT_FALSE(ended.timed_out);
}

TEST_F(FastAnswers, EachOfThemIsHeardOnceInTheirOrder) {
    answers_ = 2;
    const Ended ended = run(R"("ask": { "template": "Ask", "states": { "Done": "one" } },
        "one": { "template": "Await", "states": { "Done": "two" } },
        "two": { "template": "Await", "states": { "Done": "no_more" } },
        "no_more": { "template": "AwaitBriefly", "states": { "Done": "@terminate" } })");
    EXPECT_EQ(ended.result, plan::PlanResult::Ok) << ended.message;
    EXPECT_FALSE(ended.timed_out);
}

// It raises once, for the first of the two that watch for it.
TEST_F(FastAnswers, ASupervisorThatBeginsToWatchHearsThemToo) {
    const Ended ended = run(R"("ask": { "template": "Ask", "states": { "Done": "first" } },
        "first": { "template": "Sleep", "states": { "Done": "@terminate" }, "supervisors": {
            "answered": { "template": "OnAnswer", "events": { "Seen": "second" } } } },
        "second": { "template": "AwaitBriefly", "states": { "Done": "@terminate" }, "supervisors": {
            "again": { "template": "OnAnswer", "events": { "Seen": "@terminate" } } } })");
    EXPECT_EQ(ended.result, plan::PlanResult::Ok) << ended.message;
    EXPECT_FALSE(ended.timed_out);
}

}  // namespace
}  // namespace vagus::run
