// The plan debugger in virtual time (src/run/debugger.hpp), and in real time what a pause promises.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "plan/graph.hpp"
#include "run/debugger.hpp"
#include "run/real_time.hpp"
#include "run/virtual_time.hpp"
#include "tests/plans/random_plan.hpp"
#include "toolbox/core.hpp"

namespace vagus {
namespace {

using namespace std::chrono_literals;
using run::Breakpoint;
using Kind = run::Breakpoint::Kind;
using Why = run::Stopped::Why;

// Waits 0.5 s, counts n up, until n is 3; a supervisor may end it.
constexpr std::string_view kCount = R"({
  "format": "vagus-plan/1",
  "name": "Count",
  "configuration": { "n": { "type": "int", "initial": 0 },
    "limit": { "type": "int", "initial": 3 } },
  "start": { "actor": "wait", "supervisors": {
    "tick": { "template": "Every", "in": { "seconds": 10 }, "out": { "count": "n" },
      "events": { "Tick": "@terminate" } } } },
  "actors": {
    "wait": { "template": "Wait", "in": { "seconds": "0.5" }, "states": { "Done": "step" } },
    "step": { "template": "For", "in": { "counter": "n", "last": "limit" },
      "out": { "counter": "n" }, "states": { "Loop": "wait", "Done": "@terminate" } }
  }
})";

// Calls Inner once, which waits 1 s and writes its shared and its local variable.
constexpr std::string_view kOuter = R"({
  "format": "vagus-plan/1",
  "name": "Outer",
  "configuration": { "both": { "type": "int", "initial": 0 } },
  "start": { "actor": "call" },
  "actors": { "call": { "plan": "inner.plan.json",
    "states": { "OK": "@terminate", "Interrupted": "@terminate", "Error": "@terminate" } } }
})";
constexpr std::string_view kInner = R"({
  "format": "vagus-plan/1",
  "name": "Inner",
  "configuration": { "both": { "type": "int", "access": "shared" },
    "own": { "type": "int", "initial": 5 } },
  "start": { "actor": "nap" },
  "actors": {
    "nap": { "template": "Wait", "in": { "seconds": 1 }, "states": { "Done": "put" } },
    "put": { "template": "Assign", "in": { "value": "own + 1" }, "out": { "result": "both" },
      "states": { "Done": "@terminate" } } }
})";

class Texts final : public plan::Files {
public:
    explicit Texts(std::string_view outer) : outer_(outer) {}
    Result<std::string> read(const std::string& path) const override {
        return std::string(path.ends_with("inner.plan.json") ? kInner : outer_);
    }

private:
    std::string_view outer_;
};

// A plan in virtual time with its debugger, driven from the test's thread.
class Session {
public:
    explicit Session(const plan::Files& files, const std::vector<run::Coded>& more) {
        toolbox::add_core(library_);
        if (!more.empty()) library_.add("test", "", more);
        checked_ = plan::check("main.plan.json", files, library_.templates());
        EXPECT_TRUE(checked_.ok()) << plan::format_findings_json(checked_.findings);
        graph_ = plan::make_graph(checked_);
        debugger_ = std::make_unique<run::Debugger>(graph_, run::Debugger::At::Start);
        options_.on_trace = [this](const plan::TraceEvent& event) {
            trace_ += plan::format_trace(event) + "\n";
        };
    }
    explicit Session(std::string_view text) : Session(Texts(text), {}) {}
    ~Session() {
        if (!runner_.joinable()) return;
        EXPECT_TRUE(debugger_->post(run::Abort{}).ok());
        runner_.join();
    }

    void start() {
        options_.debugger = debugger_.get();
        runner_ = std::thread([this] { run::VirtualTime(graph_, library_, options_).run(); });
        EXPECT_EQ(next_stop().why, Why::Start);
    }
    void start_real_time() {
        options_.debugger = debugger_.get();
        runner_ = std::thread([this] {
            run::RealTime real(graph_, library_, options_);
            real.run();
            lateness_ = real.lateness();
        });
        EXPECT_EQ(next_stop().why, Why::Start);
    }

    Result<run::Reply> ask(run::Request request) {
        const uint64_t number = debugger_->post(std::move(request)).value();
        for (;;) {
            run::Report report = next();
            auto* answer = std::get_if<run::Answer>(&report);
            if (!answer) {
                later_.push_back(std::move(report));
                continue;
            }
            EXPECT_EQ(answer->request, number);
            return answer->reply;
        }
    }
    int add(Breakpoint breakpoint) {
        return std::get<int>(ask(run::AddBreakpoint{std::move(breakpoint)}).value());
    }
    std::string refused(run::Request request) {
        const auto reply = ask(std::move(request));
        return reply.ok() ? "accepted" : reply.error().what;
    }
    void expect_done(run::Request request) { EXPECT_EQ(refused(std::move(request)), "accepted"); }
    run::Stopped go_on() {
        expect_done(run::Continue{});
        return next_stop();
    }
    run::Stopped step() {
        expect_done(run::Step{});
        return next_stop();
    }
    run::Stopped next_stop() { return std::get<run::Stopped>(next_unasked()); }
    run::RunOver finish() {
        expect_done(run::Continue{});
        return wait_over();
    }
    run::RunOver wait_over() {
        const auto over = std::get<run::RunOver>(next_unasked());
        runner_.join();
        return over;
    }
    void limit(Duration most) { options_.max_time = most; }
    void step_to_the_end() {
        for (;;) {
            const run::Report report = next();
            if (std::holds_alternative<run::RunOver>(report)) break;
            if (!std::holds_alternative<run::Stopped>(report)) continue;
            EXPECT_TRUE(debugger_->post(run::Step{}).ok());
            EXPECT_TRUE(debugger_->post(run::Pause{}).ok());
        }
        runner_.join();
    }
    const std::string& trace() const { return trace_; }  // when the run is over
    run::Lateness lateness() const { return lateness_; }

private:
    run::Report next() {
        for (;;) {
            if (auto report = debugger_->wait_report(1s)) return *report;
        }
    }
    run::Report next_unasked() {
        if (later_.empty()) return next();
        run::Report report = later_.front();
        later_.erase(later_.begin());
        return report;
    }

    run::CodeLibrary library_;
    plan::Checked checked_;
    plan::Graph graph_;
    run::RunOptions options_;
    std::unique_ptr<run::Debugger> debugger_;
    std::string trace_;
    std::vector<run::Report> later_;
    run::Lateness lateness_;
    std::thread runner_;
};

const run::LevelNow& innermost(const run::Stopped& stopped) {
    return stopped.where.levels.back();
}

TEST(PlanDebugger, StopsBeforeAnActorBeginsFromTheNthTimeOn) {
    Session session(kCount);
    session.start();
    const int id = session.add({.element = "step", .stop_at = 2});

    const run::Stopped second = session.go_on();
    EXPECT_EQ(second.why, Why::Breakpoint);
    EXPECT_EQ(second.breakpoints, std::vector<int>{id});
    EXPECT_EQ(second.where.at, 1s);
    EXPECT_EQ(innermost(second).phase, plan::Phase::Pending);
    EXPECT_EQ(innermost(second).activation, 4u);
    EXPECT_EQ(session.go_on().where.at, 1500ms);
}

TEST(PlanDebugger, StopsAtAStateWithItsOutputsWritten) {
    Session session(kCount);
    session.start();
    session.add({.kind = Kind::State, .element = "step", .outcome = "Loop", .condition = "n == 2"});

    const run::Stopped stopped = session.go_on();
    EXPECT_EQ(stopped.where.at, 1s);
    EXPECT_EQ(innermost(stopped).variables[0].value, plan::Value(int64_t{2}));
    EXPECT_EQ(innermost(stopped).actor, "wait");
}

TEST(PlanDebugger, StopsAtAnEventThatWasRaised) {
    Session session(kOuter);
    session.start();
    EXPECT_NE(session.refused(run::AddBreakpoint{{.kind = Kind::Event, .element = "call"}}),
              "accepted");
    Session counting(kCount);
    counting.start();
    counting.add({.kind = Kind::Event, .element = "tick", .outcome = "Tick"});
    counting.add({.element = "step"});
    EXPECT_EQ(counting.go_on().where.at, 500ms);
    counting.expect_done(run::SetVariable{0, "limit", plan::Value(int64_t{1000})});
    counting.expect_done(run::RemoveBreakpoint{2});
    // The event ends the plan: the run is over before it could pause.
    EXPECT_EQ(counting.finish().at, 10s);
}

TEST(PlanDebugger, StopsWhenAConditionBecomesTrueNotWhileItIs) {
    Session session(kCount);
    session.start();
    session.add({.kind = Kind::Condition, .condition = "n >= 2"});

    const run::Stopped stopped = session.go_on();
    EXPECT_EQ(stopped.where.at, 1s);
    EXPECT_EQ(session.finish().at, 2500ms);
    EXPECT_NE(session.trace(), "");
}

TEST(PlanDebugger, AConditionThatFailsDoesNotHoldAndIsListed) {
    Session session(kCount);
    session.start();
    session.add({.kind = Kind::Condition, .condition = "1 / n == 1"});
    session.add({.element = "wait"});

    EXPECT_EQ(session.go_on().breakpoints, std::vector<int>{2});
    const auto list =
        std::get<std::vector<Breakpoint>>(session.ask(run::ListBreakpoints{}).value());
    EXPECT_NE(list[0].trouble, "");
    EXPECT_EQ(list[0].hits, 0u);
    EXPECT_EQ(list[1].hits, 1u);
    session.expect_done(run::EnableBreakpoint{2, false});
    EXPECT_EQ(session.go_on().breakpoints, std::vector<int>{1});
}

TEST(PlanDebugger, StepsFromActorToActorThroughSubPlans) {
    Session session(kOuter);
    session.start();
    EXPECT_EQ(innermost(session.step()).actor, "call");
    EXPECT_EQ(innermost(session.step()).actor, "nap");
    const run::Stopped put = session.step();
    EXPECT_EQ(innermost(put).actor, "put");
    EXPECT_EQ(innermost(put).path, "Outer/call");
    EXPECT_EQ(put.where.at, 1s);
}

TEST(PlanDebugger, ConditionsSeeSharedVariablesFromBothPlans) {
    Session session(kOuter);
    session.start();
    const int outer = session.add({.kind = Kind::Condition, .condition = "both == 6"});
    const int inner =
        session.add({.kind = Kind::Condition, .plan = "Inner", .condition = "both > own"});
    EXPECT_EQ(session.go_on().breakpoints, (std::vector<int>{outer, inner}));
}

TEST(PlanDebugger, SetsAndReadsVariablesOfInnerAndOuterPlans) {
    Session session(kOuter);
    session.start();
    session.add({.plan = "Inner", .element = "put"});
    session.go_on();
    session.expect_done(run::SetVariable{1, "own", plan::Value(std::string("41"))});
    session.expect_done(run::SetVariable{1, "both", plan::Value(7.5)});
    EXPECT_EQ(std::get<plan::Value>(session.ask(run::Evaluate{0, "both * 2"}).value()),
              plan::Value(int64_t{16}));
    EXPECT_EQ(session.refused(run::SetVariable{1, "onw", plan::Value(true)}),
              "the plan Inner has no variable \"onw\"; did you mean own?");
    EXPECT_EQ(session.refused(run::Evaluate{2, "1"}),
              "there is no level 2; the plans that run have the levels 0 to 1");
    session.finish();
    EXPECT_NE(session.trace().find(R"("plan":"Outer/call","kind":"write","variable":"both",)"
                                   R"("value":42,"by":"put")"),
              std::string::npos)
        << session.trace();
    EXPECT_NE(session.trace().find(R"("variable":"own","value":41,"by":"outside")"),
              std::string::npos);
}

TEST(PlanDebugger, RaisesAnEventByHandWithItsOutputs) {
    Session session(kCount);
    session.start();
    session.expect_done(run::Pause{700ms});
    EXPECT_EQ(session.go_on().why, Why::Instant);
    EXPECT_EQ(session.refused(run::RaiseEvent{"tik", "Tick"}),
              "no supervisor \"tik\" watches now; did you mean tick?");
    EXPECT_EQ(session.refused(run::RaiseEvent{"tick", "Tack"}),
              "Every has no event \"Tack\"; did you mean Tick?");
    session.expect_done(run::RaiseEvent{"tick", "Tick", {{"count", plan::Value(2.6)}}});
    const run::RunOver over = session.wait_over();
    EXPECT_EQ(over.result, plan::PlanResult::Interrupted);
    EXPECT_EQ(over.at, 700ms);
    EXPECT_NE(session.trace().find(R"("variable":"n","value":3,"by":"tick")"), std::string::npos);
}

TEST(PlanDebugger, AbortBeforeTheStartStartsNothing) {
    Session session(kCount);
    session.start();
    EXPECT_NE(session.refused(run::SetVariable{0, "n", plan::Value(true)}), "accepted");
    session.expect_done(run::Abort{});
    EXPECT_EQ(session.wait_over().result, plan::PlanResult::Interrupted);
    EXPECT_EQ(session.trace(), "");
}

TEST(PlanDebugger, HoldsOneThousandBreakpointsAndNoMore) {
    Session session(kCount);
    session.start();
    for (size_t i = 0; i < run::kBreakpointsMax; ++i) session.add({.element = "step"});
    EXPECT_NE(session.refused(run::AddBreakpoint{{.element = "step"}}), "accepted");
    EXPECT_EQ(session.refused(run::RemoveBreakpoint{4711}),
              "there is no breakpoint 4711; `list` shows those there are");
}

TEST(PlanDebugger, TakesTenThousandRequestsAndNoMore) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    const Texts files(kCount);
    const auto checked = plan::check("main.plan.json", files, library.templates());
    const plan::Graph graph = plan::make_graph(checked);
    run::Debugger debugger(graph, run::Debugger::At::Run);
    for (size_t i = 0; i < run::kDebugQueueMax; ++i)
        ASSERT_TRUE(debugger.post(run::AskWhere{}).ok());
    EXPECT_FALSE(debugger.post(run::AskWhere{}).ok());
}

// The promise: pausing changes nothing. Stepped through, random plans give the trace of a run
// without a debugger.
TEST(PlanDebugger, APausedRunGivesTheTraceThatItWouldHaveGiven) {
    for (uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        const RandomPlans files(seed);
        run::CodeLibrary library;
        toolbox::add_core(library);
        const auto checked = plan::check("main.plan.json", files, library.templates());
        ASSERT_TRUE(checked.ok());
        const plan::Graph graph = plan::make_graph(checked);
        const auto traced = [&](run::Debugger* debugger) {
            std::string lines;
            int count = 0;
            run::VirtualTime* running = nullptr;
            run::RunOptions options;
            options.max_time = 2s;
            options.debugger = debugger;
            options.on_trace = [&](const plan::TraceEvent& event) {
                lines += plan::format_trace(event) + "\n";
                if (++count == 300) running->abort();
            };
            run::VirtualTime run(graph, library, options);
            running = &run;
            run.run();
            return lines;
        };
        const std::string plain = traced(nullptr);
        run::Debugger debugger(graph, run::Debugger::At::Run);
        ASSERT_TRUE(debugger.post(run::Pause{}).ok());
        int stops = 0;
        std::thread stepper([&debugger, &stops] {
            for (;;) {
                const auto report = debugger.wait_report(1s);
                if (!report) continue;
                if (std::holds_alternative<run::RunOver>(*report)) return;
                if (!std::holds_alternative<run::Stopped>(*report)) continue;
                // Every third time also a pause between two instants.
                if (++stops % 3 == 0) (void)debugger.post(run::Pause{stops * 1777us}).ok();
                (void)debugger.post(run::Step{}).ok();
            }
        });
        EXPECT_EQ(traced(&debugger), plain);
        stepper.join();
        EXPECT_GE(stops, 1);
    }
}

// ---- real time ----

// Tells when it is held and released; ends when it has been both.
class Driver final : public run::Actor {
public:
    struct Seen {
        std::atomic<bool> drives = false;
        std::atomic<int> held = 0;
        std::atomic<int> released = 0;
    };
    explicit Driver(Seen& seen) : seen_(seen) {}
    void run(run::ActorContext& context) override {
        seen_.drives = true;
        while (seen_.released == 0) context.sleep(1ms);
        context.end(0);
    }
    void held() override { ++seen_.held; }
    void released() override { ++seen_.released; }

private:
    Seen& seen_;
};

TEST(PlanDebugger, InRealTimeAPauseHoldsTheCodeAtItsWaitAndTellsIt) {
    Driver::Seen seen;
    run::Coded coded;
    coded.declared.name = "Drive";
    coded.declared.outcomes = {{.name = "Arrived"}};
    coded.actor = [&seen] { return std::make_unique<Driver>(seen); };
    Session session(Texts(R"({ "format": "vagus-plan/1", "name": "Drives", "toolboxes": ["test"],
        "start": { "actor": "drive" }, "actors": { "drive": { "template": "Drive",
        "states": { "Arrived": "@terminate" } } } })"),
                    {coded});
    session.start_real_time();
    session.expect_done(run::Step{});
    session.next_stop();
    session.expect_done(run::Continue{});
    while (!seen.drives) std::this_thread::yield();
    session.expect_done(run::Pause{});
    const run::Stopped stopped = session.next_stop();
    EXPECT_EQ(innermost(stopped).phase, plan::Phase::Running);
    while (seen.held == 0) std::this_thread::yield();
    EXPECT_EQ(seen.released, 0);
    EXPECT_EQ(session.finish().result, plan::PlanResult::Ok);
    EXPECT_EQ(seen.held, 1);
    EXPECT_EQ(seen.released, 1);
}

// The clock is stopped while paused: a second look tells the same instant, and the deadlines that
// passed meanwhile by the clock on the wall are not made up for.
TEST(PlanDebugger, InRealTimeTheRunsClockStandsWhilePaused) {
    Session session(R"({ "format": "vagus-plan/1", "name": "Watched",
        "configuration": { "x": { "type": "int", "initial": 0 } },
        "start": { "actor": "rest", "supervisors": { "watch": { "template": "Watch",
          "period_ms": 1, "in": { "left": "x", "op": "'=='", "right": 1 },
          "events": { "True": "@terminate" } } } },
        "actors": { "rest": { "template": "WaitForever", "states": {} } } })");
    session.start_real_time();
    session.step();
    const auto first = std::get<run::Where>(session.ask(run::AskWhere{}).value());
    // Far longer by the clock on the wall than a check is late on a busy machine.
    const auto before = std::chrono::steady_clock::now();
    auto paused = before - before;
    while (paused < 1s) {
        EXPECT_TRUE(session.ask(run::AskWhere{}).ok());
        paused = std::chrono::steady_clock::now() - before;
    }
    const auto second = std::get<run::Where>(session.ask(run::AskWhere{}).value());
    EXPECT_EQ(first.at, second.at);
    session.expect_done(run::SetVariable{0, "x", plan::Value(int64_t{1})});
    EXPECT_EQ(session.finish().result, plan::PlanResult::Interrupted);
    EXPECT_LT(session.lateness().worst, paused);
}

TEST(PlanDebugger, InRealTimeRandomPlansAreSteppedAndPausedWithoutHarm) {
    for (uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        const RandomPlans files(seed);
        Session session(files, {});
        session.limit(150ms);
        session.start_real_time();
        session.expect_done(run::Step{});
        session.step_to_the_end();
    }
}

}  // namespace
}  // namespace vagus
