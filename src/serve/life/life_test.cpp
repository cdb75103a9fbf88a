// The rules: every command is answered exactly once; after Stop nothing is let go until somebody
// asks; what was opened is closed.
#include "serve/life/life.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <string>

#include "base/rng.hpp"

namespace vagus::serve {
namespace {

using namespace life;
using State = Life::State;

std::string word(const Action& action) {
    static constexpr const char* kWords[] = {
        "open-runner", "connect", "load",        "let-go", "begin",    "continue",   "step",
        "pause",       "rest",    "pause-nodes", "count",  "end-plan", "stop-nodes", "make-safe",
        "disconnect",  "leaving", "answer",      "stood",  "tell"};
    return kWords[action.index()];
}

// A life with everything around it scripted: runners open and nodes answer when they are told to.
struct Bench {
    Life life;
    Time now{};
    CallNumber calls = 0;
    std::map<CallNumber, int> answers;  // of each command
    std::map<CallNumber, Answer> said;
    std::vector<End> ends;
    uint64_t load = 0, go = 0, stop = 0;  // what was asked for last
    bool runner = false;
    bool asked = true;  // somebody wants that something runs
    std::string did;    // words of what was done since the last look

    std::string take(const Input& input) {
        std::string all;
        for (const Action& action : life.take(input, now)) all += note(action);
        return all;
    }
    std::string pass(Duration time, bool silent = false) {
        now += time;
        std::string all;
        for (const Action& action : life.tick(now, silent)) all += note(action);
        return all;
    }
    CallNumber call() {
        answers[++calls] = 0;
        return calls;
    }
    // A start of the scripts in a world, to its end.
    void run_world(bool plan = false) {
        take(Start{call(), plan, true});
        take(Opened{});
        take(Described{});
        take(Loaded{load});
        ASSERT_EQ(life.state(), State::Running);
    }
    void run_bus_plan() {
        take(Joined{});
        take(Start{call(), true});
        take(Stopped{stop, {{{1, "drive", StopNode::State::Stopped}}}});
        take(Loaded{load});
        take(Opened{});
        take(Went{go});
        ASSERT_EQ(life.state(), State::Running);
    }

    std::string note(const Action& action) {
        if (const auto* answer = std::get_if<Answer>(&action)) {
            ++answers[answer->call];
            said[answer->call] = *answer;
        }
        if (const auto* stood = std::get_if<AnswerStop>(&action)) ++answers[stood->call];
        if (const auto* leaving = std::get_if<GoOnLeaving>(&action)) ++answers[leaving->call];
        if (const auto* told = std::get_if<Tell>(&action)) {
            if (!told->again) ends.push_back(told->end);
        }
        if (const auto* loads = std::get_if<LoadNodes>(&action)) load = loads->start;
        if (const auto* goes = std::get_if<LetNodesGo>(&action)) go = goes->start;
        if (const auto* stops = std::get_if<StopNodes>(&action)) stop = stops->number;
        if (std::holds_alternative<OpenRunner>(action)) runner = true;
        if (std::holds_alternative<Disconnect>(action)) runner = false;
        return word(action) + " ";
    }
};

StopReport stood() {
    return {{{1, "drive", StopNode::State::Stopped}}};
}

// ---- beginning ----

TEST(Life, AWorldIsOpenedLoadedAndRuns) {
    Bench bench;
    const CallNumber call = bench.call();
    EXPECT_EQ(bench.take(Start{call, false, true}), "open-runner ");
    EXPECT_EQ(bench.life.state(), State::Opening);
    EXPECT_EQ(bench.take(Opened{}), "connect ");
    EXPECT_EQ(bench.take(Described{}), "load ");
    EXPECT_EQ(bench.take(Loaded{bench.load}), "begin count answer ");
    EXPECT_EQ(bench.life.state(), State::Running);
    EXPECT_EQ(bench.said[call].why, "");
}

TEST(Life, NodesThatDoNotSayWhatTheyAreAreNotWaitedForForEver) {
    Bench bench;
    bench.take(Start{bench.call(), false, true});
    bench.take(Opened{});
    EXPECT_EQ(bench.pass(kDescribeWithin - 1ms), "");
    EXPECT_EQ(bench.pass(1ms), "load ");
}

// Without this the next start of a world would find one still under way.
TEST(Life, AStartThatIsOverIsNotUnderWay) {
    Bench bench;
    bench.run_world();
    EXPECT_FALSE(bench.life.is_starting());
    const CallNumber again = bench.call();
    EXPECT_EQ(bench.take(Start{again, false, true}), "open-runner ");
    bench.take(Opened{});
    bench.take(Described{});
    bench.take(Loaded{bench.load});
    EXPECT_EQ(bench.answers[again], 1);
    EXPECT_EQ(bench.said[again].why, "");
}

TEST(Life, ASecondStartOfAPlanIsRefusedWhileTheFirstIsUnderWay) {
    Bench bench;
    bench.take(Start{bench.call(), true, true});
    const CallNumber second = bench.call();
    EXPECT_EQ(bench.take(Start{second, true, true}), "answer ");
    EXPECT_EQ(bench.said[second].code, "conflict");
    bench.take(Opened{});
    bench.take(Described{});
    EXPECT_EQ(bench.take(Loaded{bench.load}), "begin count answer ");
    // From then on it continues what is paused.
    EXPECT_EQ(bench.take(Start{bench.call(), true, true}), "load ");
    EXPECT_EQ(bench.take(Loaded{bench.load}), "let-go ");
    EXPECT_EQ(bench.take(Went{bench.go}), "continue answer ");
}

// Two breakpoints of one moment: time is stopped at the second, too.
TEST(Life, TimeStaysWhereItIsIfANodeHaltsWhileNodesAreLetGo) {
    Bench bench;
    bench.run_world();
    EXPECT_EQ(bench.take(Halted{}), "pause ");
    bench.take(Start{bench.call()});
    bench.take(Loaded{bench.load});
    EXPECT_EQ(bench.take(Halted{}), "pause ");
    EXPECT_EQ(bench.take(Went{bench.go}), "answer ");
    EXPECT_EQ(bench.life.state(), State::Paused);
}

// Nobody knows what the nodes of a bus do when it is connected.
TEST(Life, APlanOnABusBeginsWithARobotThatIsKnownToBeAtRest) {
    Bench bench;
    EXPECT_EQ(bench.take(Joined{}), "");
    const CallNumber call = bench.call();
    EXPECT_EQ(bench.take(Start{call, true}), "stop-nodes ");
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "load ");
    EXPECT_EQ(bench.take(Loaded{bench.load}), "open-runner ");
    EXPECT_EQ(bench.take(Opened{}), "let-go ");
    EXPECT_EQ(bench.take(Went{bench.go}), "continue count answer ");
    EXPECT_TRUE(bench.ends.empty());  // nothing has ended
    EXPECT_EQ(bench.take(Stop{bench.call(), {"Ann"}}), "end-plan stop-nodes ");
    bench.take(Stopped{bench.stop, stood()});
    bench.take(PlanEnded{"Interrupted"});
    EXPECT_EQ(bench.take(Start{bench.call(), true}), "load ");  // it is known now
}

// ---- ending ----

TEST(Life, OnABusNothingIsWaitedForBeforeTheNodesAreTold) {
    Bench bench;
    bench.run_bus_plan();
    const CallNumber call = bench.call();
    EXPECT_EQ(bench.take(Stop{call, {"Ann"}}), "end-plan stop-nodes ");
    EXPECT_EQ(bench.life.state(), State::Stopping);
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "stood ");
    EXPECT_TRUE(bench.ends.empty());  // the plan has not said how it ended
    EXPECT_EQ(bench.take(PlanEnded{"Interrupted"}), "tell ");
    ASSERT_EQ(bench.ends.size(), 1U);
    EXPECT_EQ(bench.ends[0].cause.by, "Ann");
    EXPECT_EQ(bench.ends[0].result, "Interrupted");
    ASSERT_EQ(bench.ends[0].nodes.size(), 1U);
    EXPECT_EQ(bench.ends[0].nodes[0].state, StopNode::State::Stopped);
}

TEST(Life, InAWorldThePlanEndsFirstButHasNoMoreThanAMoment) {
    for (const bool ends : {true, false}) {
        Bench bench;
        bench.run_world(true);
        const CallNumber call = bench.call();
        EXPECT_EQ(bench.take(Stop{call, {"Ann"}}), "end-plan ");
        if (ends) {
            EXPECT_EQ(bench.take(PlanEnded{"Interrupted"}), "stop-nodes ");
        } else {
            EXPECT_EQ(bench.pass(kPlanEndsWithin - 1ms), "");
            EXPECT_EQ(bench.pass(1ms), "stop-nodes ");
        }
        EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), ends ? "stood tell " : "stood ");
        EXPECT_EQ(bench.life.state(), State::ComingToRest);
        // One that did not end is abandoned, with its world.
        EXPECT_EQ(bench.pass(kRollOut), ends ? "rest " : "tell open-runner ");
    }
}

TEST(Life, AProcessThatHangsIsLeftAsItIs) {
    Bench bench;
    bench.run_world();
    bench.take(Stop{bench.call(), {"Ann"}});
    bench.take(Stopped{bench.stop, {}});
    EXPECT_EQ(bench.pass(kRollOut, true), "");
    EXPECT_EQ(bench.pass(1ms, false), "rest ");
}

TEST(Life, WhoStopsIsAnsweredEvenIfNothingIsHeardOfTheNodes) {
    Bench bench;
    bench.run_bus_plan();
    const CallNumber call = bench.call(), second = bench.call();
    bench.take(Stop{call, {"Ann"}});
    bench.take(Stop{second, {"Bob"}});
    EXPECT_EQ(bench.pass(kReportWithin - 1ms), "");
    EXPECT_EQ(bench.pass(1ms), "stood stood ");
    // The result of a plan that swallows Stop is not waited for for ever.
    EXPECT_EQ(bench.pass(kResultWithin), "tell ");
    ASSERT_EQ(bench.ends.size(), 1U);
    EXPECT_EQ(bench.ends[0].result, "");
}

TEST(Life, APlanThatEndsWellLeavesItsScriptsRunning) {
    for (const char* result : {"OK", "Interrupted"}) {
        Bench bench;
        bench.run_bus_plan();
        EXPECT_EQ(bench.take(PlanEnded{result}), "make-safe tell ");
        EXPECT_EQ(bench.life.state(), State::Running);
        EXPECT_EQ(bench.ends[0].cause.why, Why::Plan);
    }
}

TEST(Life, APlanThatFailsStopsTheRobot) {
    Bench bench;
    bench.run_bus_plan();
    EXPECT_EQ(bench.take(PlanEnded{"Error", "go: it is broken"}), "stop-nodes ");
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "tell ");
    EXPECT_EQ(bench.ends[0].cause.why, Why::Error);
    EXPECT_EQ(bench.ends[0].message, "go: it is broken");
}

// A caller that waits for the start is told why, not that it was stopped.
TEST(Life, APlanThatFailsWhileItIsBeingStartedSaysWhy) {
    Bench bench;
    const CallNumber call = bench.call();
    bench.take(Start{call, true, true});
    bench.take(Opened{});
    bench.take(PlanEnded{"Error", "go: it is broken"});
    EXPECT_EQ(bench.answers[call], 1);
    EXPECT_EQ(bench.said[call].why, "its plan ended in an error: go: it is broken");
}

TEST(Life, AProcessThatDiesWithItsPlanStopsTheRobot) {
    Bench bench;
    bench.run_bus_plan();
    EXPECT_EQ(bench.take(Died{"killed"}), "stop-nodes ");
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "tell ");
    EXPECT_EQ(bench.ends[0].cause.why, Why::Died);
    EXPECT_EQ(bench.ends[0].result, "Error");
}

TEST(Life, LeavingWaitsUntilTheRobotHasStopped) {
    Bench bench;
    bench.run_bus_plan();
    EXPECT_EQ(bench.take(Leave{bench.call(), {"Ann", Why::Target}}), "end-plan stop-nodes ");
    const CallNumber late = bench.call();
    EXPECT_EQ(bench.take(Start{late, true}), "");
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "answer tell disconnect leaving ");
    EXPECT_EQ(bench.said[late].code, "failed");
    EXPECT_EQ(bench.ends[0].cause.why, Why::Target);
    EXPECT_EQ(bench.life.state(), State::None);
}

TEST(Life, WhoOnlyLooksStopsNothing) {
    Bench bench;
    bench.take(Joined{});
    EXPECT_EQ(bench.take(Leave{bench.call(), {"Ann", Why::Target}, false}), "disconnect leaving ");
    bench.take(Joined{});
    EXPECT_EQ(bench.take(Leave{bench.call(), {"Ann", Why::Target}, true}), "stop-nodes ");
}

TEST(Life, StopWhileAWorldOpensLeavesTheWorldAlone) {
    Bench bench;
    const CallNumber start = bench.call();
    bench.take(Start{start, true, true});
    EXPECT_EQ(bench.take(Stop{bench.call(), {"Ann"}}), "answer stood ");
    EXPECT_EQ(bench.said[start].why, "it was stopped");
    EXPECT_EQ(bench.take(Opened{}), "open-runner ");  // again, without the plan
    EXPECT_EQ(bench.take(Opened{}), "connect ");
    bench.take(Described{});
    EXPECT_EQ(bench.take(Loaded{bench.load}), "");
    EXPECT_EQ(bench.life.state(), State::Ready);
}

TEST(Life, RunAfterStopWaitsForItAndIsVoidAfterAnother) {
    Bench bench;
    bench.run_bus_plan();
    bench.take(Stop{bench.call(), {"Ann"}});
    const CallNumber run = bench.call(), second = bench.call();
    EXPECT_EQ(bench.take(Start{run, true}), "");
    EXPECT_EQ(bench.take(Start{second, true}), "answer ");
    EXPECT_EQ(bench.take(Stop{bench.call(), {"Ann"}}), "answer ");
    EXPECT_EQ(bench.said[run].why, "it was stopped");
    EXPECT_EQ(bench.take(Start{bench.call(), true}), "");
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "stood stood tell load ");
}

TEST(Life, WhatComesLateForAStartThatIsVoidSaysNothing) {
    Bench bench;
    bench.run_bus_plan();
    bench.take(Start{bench.call(), false});
    const uint64_t load = bench.load, go = bench.go;
    bench.take(Stop{bench.call(), {"Ann"}});
    bench.take(Stopped{bench.stop, stood()});
    bench.take(Start{bench.call(), false});
    EXPECT_EQ(bench.take(Loaded{load}), "");
    EXPECT_EQ(bench.take(Loaded{bench.load}), "count let-go ");
    EXPECT_EQ(bench.take(Went{go}), "");
    EXPECT_EQ(bench.take(Went{bench.go}), "answer ");
}

TEST(Life, ANodeThatAnswersLateIsToldAgain) {
    Bench bench;
    bench.run_bus_plan();
    bench.take(Stop{bench.call(), {"Ann"}});
    const uint64_t stop = bench.stop;
    bench.take(Stopped{stop, {{{1, "drive", StopNode::State::Silent}}}});
    bench.take(PlanEnded{"Interrupted"});
    EXPECT_EQ(bench.take(Stopped{stop, stood()}), "tell ");
    EXPECT_EQ(bench.ends.size(), 1U);  // once
    EXPECT_EQ(bench.take(Stopped{stop - 1, stood()}), "");
    // What does not answer is not known to be at rest: it is told to stop before the next run.
    EXPECT_EQ(bench.take(Start{bench.call(), true}), "stop-nodes ");
}

TEST(Life, AStepIntoAScriptIsVoidAfterStop) {
    Bench bench;
    bench.run_bus_plan();
    const CallNumber into = bench.call();
    bench.take(StepInto{into});
    EXPECT_EQ(bench.take(Stop{bench.call(), {"Ann"}}), "answer end-plan stop-nodes ");
    EXPECT_EQ(bench.pass(kIntoWithin), "");
    EXPECT_EQ(bench.answers[into], 1);
}

// ---- the rules, over everything that can happen ----

// One input of each kind. Answers of nodes and runners are to what was asked last.
using Make = std::function<Input(Bench&)>;
const std::vector<Make>& inputs() {
    static const std::vector<Make> kInputs = {
        [](Bench&) { return Joined{}; },
        [](Bench& b) {
            return Open{b.call(), false};
        },
        [](Bench& b) {
            return Open{b.call(), true};
        },
        [](Bench& b) {
            return Start{b.call(), false, false};
        },
        [](Bench& b) {
            return Start{b.call(), false, true};
        },
        [](Bench& b) {
            return Start{b.call(), true, true};
        },
        [](Bench& b) {
            return Start{b.call(), true, false, false, true};
        },
        [](Bench&) { return Opened{}; },
        [](Bench&) { return Failed{"it cannot"}; },
        [](Bench&) { return Described{}; },
        [](Bench& b) { return Loaded{b.load}; },
        [](Bench& b) { return Went{b.go}; },
        [](Bench&) { return Halted{}; },
        [](Bench& b) { return Pause{b.call()}; },
        [](Bench& b) {
            return NodesPaused{b.calls, ""};
        },
        [](Bench& b) { return HoldPlan{b.call()}; },
        [](Bench& b) { return ContinuePlan{b.call()}; },
        [](Bench& b) {
            return EndThePlan{b.call(), "Ann"};
        },
        [](Bench& b) { return StepInto{b.call()}; },
        [](Bench&) { return BreakpointsSet{}; },
        [](Bench&) { return PlanEnded{"OK"}; },
        [](Bench&) {
            return PlanEnded{"Error", "why"};
        },
        [](Bench&) { return Died{"killed"}; },
        [](Bench& b) {
            return Stop{b.call(), {"Ann"}};
        },
        [](Bench& b) {
            return Stopped{b.stop, stood()};
        },
        [](Bench& b) {
            return Leave{b.call(), {"Ann", Why::Target}, false};
        },
        [](Bench& b) {
            return Leave{b.call(), {"Ann", Why::Target}, true};
        },
    };
    return kInputs;
}

bool asks_for_a_run(const Input& input) {
    return std::holds_alternative<Start>(input) || std::holds_alternative<ContinuePlan>(input) ||
           std::holds_alternative<StepInto>(input) ||
           (std::holds_alternative<Open>(input) && std::get<Open>(input).go);
}

bool lets_run(const std::string& words) {
    for (const char* one : {"let-go", "begin", "continue", "step "}) {
        if (words.find(one) != std::string::npos) return true;
    }
    return false;
}

// A bus is joined only where nothing is connected: the server leaves one target first.
bool may_come(const Bench& bench, const Input& input) {
    return !std::holds_alternative<Joined>(input) || bench.life.state() == State::None;
}

void feed(Bench& bench, const Make& make, const std::string& where) {
    const Input input = make(bench);
    if (!may_come(bench, input)) return;
    if (asks_for_a_run(input)) bench.asked = true;
    if (std::holds_alternative<Stop>(input)) bench.asked = false;
    const std::string did = bench.take(input);
    EXPECT_TRUE(bench.asked || !lets_run(did)) << where << did;
    for (const auto& [call, times] : bench.answers) EXPECT_LE(times, 1) << where << call;
}

// Callers that still wait are answered by the end of everything: the nodes are silent, the pause is
// answered by the nodes or by leaving.
void finish(Bench& bench, const std::string& where) {
    bench.take(Leave{bench.call(), {"Ann", Why::Project}, true});
    bench.pass(kPlanEndsWithin);
    bench.pass(kReportWithin);
    for (const auto& [call, times] : bench.answers) {
        EXPECT_EQ(times, 1) << where << "command " << call;
    }
    EXPECT_FALSE(bench.runner) << where;
    EXPECT_EQ(bench.life.state(), State::None) << where;
    EXPECT_EQ(bench.life.next_tick(), Time::max()) << where;
}

// Ways to each of the states.
const std::vector<std::pair<State, std::function<void(Bench&)>>>& ways() {
    using Way = std::pair<State, std::function<void(Bench&)>>;
    static const std::vector<Way> kWays = {
        {State::None, [](Bench&) {}},
        {State::Opening,
         [](Bench& b) {
             b.take(Start{b.call(), true, true});
         }},
        {State::Opening, [](Bench& b) { b.take(Open{b.call()}); }},
        {State::Loading,
         [](Bench& b) {
             b.take(Start{b.call(), true, true});
             b.take(Opened{});
         }},
        {State::Loading,
         [](Bench& b) {
             b.run_world();
             b.take(Start{b.call()});
         }},
        {State::Ready, [](Bench& b) { b.take(Joined{}); }},
        {State::Running, [](Bench& b) { b.run_world(); }},
        {State::Running, [](Bench& b) { b.run_world(true); }},
        {State::Running, [](Bench& b) { b.run_bus_plan(); }},
        {State::Paused,
         [](Bench& b) {
             b.run_world();
             b.take(Halted{});
         }},
        {State::Stopping,
         [](Bench& b) {
             b.run_bus_plan();
             b.take(Stop{b.call(), {"Ann"}});
             b.asked = false;
         }},
        {State::Stopping,
         [](Bench& b) {
             b.run_world(true);
             b.take(Stop{b.call(), {"Ann"}});
             b.asked = false;
         }},
        {State::ComingToRest,
         [](Bench& b) {
             b.run_world();
             b.take(Stop{b.call(), {"Ann"}});
             b.asked = false;
             b.take(Stopped{b.stop, stood()});
         }},
        {State::Dead,
         [](Bench& b) {
             b.run_world();
             b.take(Died{"killed"});
         }},
    };
    return kWays;
}

TEST(LifeRules, HoldForAllPairsOfInputsInEveryState) {
    for (size_t way = 0; way < ways().size(); ++way) {
        for (size_t first = 0; first < inputs().size(); ++first) {
            for (size_t second = 0; second < inputs().size(); ++second) {
                const std::string where = "way " + std::to_string(way) + ", inputs " +
                                          std::to_string(first) + " and " + std::to_string(second) +
                                          ": ";
                Bench bench;
                ways()[way].second(bench);
                ASSERT_EQ(bench.life.state(), ways()[way].first) << where;
                feed(bench, inputs()[first], where);
                feed(bench, inputs()[second], where);
                finish(bench, where);
                ASSERT_FALSE(testing::Test::HasFailure()) << where;
            }
        }
    }
}

TEST(LifeRules, HoldForAnySequence) {
    const char* given = std::getenv("VAGUS_SEED");
    const uint64_t seed = given ? std::strtoull(given, nullptr, 10) : std::random_device()();
    SCOPED_TRACE("VAGUS_SEED=" + std::to_string(seed));
    SplitMix64 dice(seed);
    for (int round = 0; round < 3000; ++round) {
        Bench bench;
        const std::string where = "round " + std::to_string(round) + ": ";
        for (int step = 0; step < 60; ++step) {
            feed(bench, inputs()[dice.next() % inputs().size()], where);
            const std::string did =
                bench.pass(std::chrono::milliseconds(dice.next() % 700), dice.next() % 8 == 0);
            ASSERT_TRUE(bench.asked || !lets_run(did)) << where << did;
        }
        finish(bench, where);
        ASSERT_FALSE(testing::Test::HasFailure()) << where;
    }
}

}  // namespace
}  // namespace vagus::serve
