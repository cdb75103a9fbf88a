// What becomes of what: beginnings and ends of runs, one by one.
#include "serve/life/test_life.hpp"

namespace vagus::serve {
namespace {

using namespace test;

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

// One that faults in its first lines, or has a breakpoint there, brakes its robot.
TEST(Life, ScriptsOfABusThatHaltAsTheyAreLoadedAreLetGoByTheNextStart) {
    Bench bench;
    bench.take(Joined{});
    const CallNumber call = bench.call();
    EXPECT_EQ(bench.take(Start{call}), "stop-nodes ");
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "scripts load ");
    EXPECT_EQ(bench.take(Halted{}), "");
    EXPECT_EQ(bench.take(Loaded{bench.load}), "count answer ");
    EXPECT_EQ(bench.life.state(), State::Paused);
    EXPECT_EQ(bench.take(Start{bench.call()}), "scripts load ");
    EXPECT_EQ(bench.take(Loaded{bench.load}), "count let-go ");
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
        EXPECT_EQ(bench.take(PlanEnded{result}), "make-safe ");
        EXPECT_EQ(bench.life.state(), State::Running);
        EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "tell ");
        EXPECT_EQ(bench.ends[0].cause.why, Why::Plan);
        EXPECT_EQ(bench.ends[0].result, result);
        EXPECT_EQ(bench.ends[0].nodes.size(), 1U);
    }
}

TEST(Life, AnEndIsToldAlsoIfNodesDoNotSayThatTheyAreSafeAndAgainWhenTheyDo) {
    Bench bench;
    bench.run_bus_plan();
    EXPECT_EQ(bench.take(PlanEnded{"OK"}), "make-safe ");
    EXPECT_EQ(bench.pass(kRestReportWithin - 1ms), "");
    EXPECT_EQ(bench.pass(1ms), "tell ");
    EXPECT_EQ(bench.ends.size(), 1U);
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "tell ");
    EXPECT_EQ(bench.ends.size(), 1U);  // once
    // Once something runs again they do what that wants.
    const uint64_t before = bench.stop;
    bench.take(Start{bench.call(), true});
    EXPECT_EQ(bench.take(Stopped{before, stood()}), "");
}

TEST(Life, AWorldIsNotWaitedForBehindItsPlan) {
    Bench bench;
    bench.run_world(true);
    EXPECT_EQ(bench.take(PlanEnded{"OK"}), "make-safe tell ");
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
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "stood stood ");
    // The plan before it ends first.
    EXPECT_EQ(bench.take(PlanEnded{"Interrupted"}), "tell load ");
}

TEST(Life, APlanThatIsStartedOverOneThatRunsOnABusEndsThatAsStopDoes) {
    Bench bench;
    bench.run_bus_plan();
    const CallNumber call = bench.call();
    EXPECT_EQ(bench.take(Start{call, true, false, true, true, false, "Ann"}),
              "end-plan stop-nodes ");
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "");
    EXPECT_EQ(bench.take(PlanEnded{"Interrupted"}), "tell load ");
    ASSERT_EQ(bench.ends.size(), 1U);
    EXPECT_EQ(bench.ends[0].cause.by, "Ann");
    EXPECT_EQ(bench.ends[0].result, "Interrupted");
    EXPECT_EQ(bench.ends[0].nodes.size(), 1U);
    EXPECT_EQ(bench.answers[call], 0);  // it is just being started
}

TEST(Life, AStartThatWaitedTooLongForTheEndOfAnotherPlanIsLate) {
    for (const bool late : {false, true}) {
        Bench bench;
        bench.run_bus_plan();
        bench.take(Stop{bench.call(), {"Ann"}});
        bench.take(Stopped{bench.stop, stood()});
        const CallNumber call = bench.call();
        EXPECT_EQ(bench.take(Start{call, true}), "");
        EXPECT_EQ(bench.pass(kRunWaitsMax + (late ? 1ms : 0ms)),
                  late ? "tell answer " : "tell load ");
        if (late) {
            EXPECT_EQ(bench.said[call].code, "late");
        }
    }
}

TEST(Life, APlanInAWorldThatIsReplacedIsToldFirst) {
    for (const bool plan : {true, false}) {
        Bench bench;
        bench.run_world(true);
        const std::string did =
            plan ? bench.take(Start{bench.call(), true, false, true, true, false, "Ann"})
                 : bench.take(Open{bench.call(), false, "Ann"});
        EXPECT_EQ(did, "tell open-runner ");
        ASSERT_EQ(bench.ends.size(), 1U);
        EXPECT_EQ(bench.ends[0].cause.by, "Ann");
        EXPECT_EQ(bench.ends[0].result, "Interrupted");
    }
}

// ---- a robot that somebody has moved meanwhile ----

TEST(Life, WhatWasDrivenByHandIsStoppedBeforeARunBegins) {
    Bench bench;
    bench.run_bus_plan();
    bench.take(Stop{bench.call(), {"Ann"}});
    bench.take(Stopped{bench.stop, stood()});
    bench.take(PlanEnded{"Interrupted"});
    Start start{bench.call(), true};
    start.quiet = false;
    EXPECT_EQ(bench.take(start), "stop-nodes ");
    EXPECT_EQ(bench.take(Stopped{bench.stop, stood()}), "load ");
}

TEST(Life, WhatGoesOnIsNotStopped) {
    Bench bench;
    bench.run_bus_plan();
    bench.take(HoldPlan{bench.call()});
    Start start{bench.call(), true};
    start.quiet = false;
    EXPECT_EQ(bench.take(start), "load ");
}

TEST(Life, NothingIsStartedOnARobotThatDoesNotComeToRest) {
    using Is = StopNode::State;
    for (const auto& [is, starts] : {std::pair(Is::Moving, false),
                                     {Is::Silent, false},
                                     {Is::Asked, false},
                                     {Is::Gone, true}}) {
        Bench bench;
        bench.take(Joined{});
        const CallNumber call = bench.call();
        bench.take(Start{call, true});
        EXPECT_EQ(bench.take(Stopped{bench.stop, {{{1, "drive", is}}}}),
                  starts ? "load " : "answer ");
        if (starts) continue;
        EXPECT_TRUE(bench.said[call].why.starts_with("node 1 (drive) did not "))
            << bench.said[call].why;
    }
}

// ---- a process that does not open what it was told to ----

TEST(Life, AProcessThatIsSilentInsteadOfOpeningIsEndedAndWhoStartsIsTold) {
    Bench bench;
    bench.take(Joined{});
    const CallNumber call = bench.call();
    bench.take(Start{call, true});
    bench.take(Stopped{bench.stop, stood()});
    EXPECT_EQ(bench.take(Loaded{bench.load}), "open-runner ");
    EXPECT_EQ(bench.pass(1s, false), "");
    EXPECT_EQ(bench.pass(kOpenSilentMax - 1ms, true), "");
    EXPECT_EQ(bench.pass(1ms, true), "end-runner answer stop-nodes ");
    EXPECT_EQ(bench.answers[call], 1);
    EXPECT_NE(bench.said[call].why.find("did not open"), std::string::npos);
    EXPECT_EQ(bench.take(Opened{}), "");  // of a process that is gone
}

TEST(Life, AWorldHasLongerToOpenButNotForEver) {
    Bench bench;
    const CallNumber call = bench.call();
    bench.take(Open{call, true});
    EXPECT_EQ(bench.pass(kOpenWithin - 1ms, true), "");
    EXPECT_EQ(bench.pass(1ms, true), "end-runner answer ");
    EXPECT_EQ(bench.said[call].code, "failed");
    EXPECT_EQ(bench.life.state(), State::None);
}

TEST(Life, ARunWithAPastHasAsLongAsItsProcessSaysThatItIsThere) {
    Bench bench;
    for (const bool plan : {false, true}) {
        const CallNumber call = bench.call();
        if (plan) {
            bench.take(Start{.call = call, .plan = true, .again = true, .past = true});
        } else {
            bench.take(Open{.call = call, .go = true, .past = true});
        }
        for (Duration passed{}; passed + 1s < kReliveWithin; passed += 1s) {
            ASSERT_EQ(bench.pass(1s, false), "");
        }
        EXPECT_EQ(bench.pass(1s - 1ms, false), "");
        EXPECT_NE(bench.pass(1ms, false).find("end-runner answer "), std::string::npos);
        EXPECT_EQ(bench.said[call].code, "failed");
        // Its world is opened again, without what failed.
        bench.take(Failed{"no"});
    }
}

// Whoever opens the recording of a plan that failed wants to see just that.
TEST(Life, APastThatEndedInAnErrorIsOpenedAtItsEnd) {
    Bench bench;
    const CallNumber call = bench.call();
    bench.take(Start{.call = call, .plan = true, .go = false, .again = true, .past = true});
    bench.take(Opened{});
    EXPECT_EQ(bench.take(PlanEnded{"Error", "go: it is broken"}), "make-safe tell ");
    EXPECT_EQ(bench.answers[call], 0);
    EXPECT_EQ(bench.ends[0].message, "go: it is broken");
}

TEST(Life, APastWhoseProcessIsSilentIsNotWaitedFor) {
    Bench bench;
    const CallNumber call = bench.call();
    bench.take(Open{.call = call, .go = true, .past = true});
    EXPECT_EQ(bench.pass(kOpenWithin + 1s, false), "");
    EXPECT_EQ(bench.pass(kOpenSilentMax - 1ms, true), "");
    EXPECT_EQ(bench.pass(1ms, true), "end-runner answer ");
    EXPECT_EQ(bench.answers[call], 1);
}

TEST(Life, WhatComesLateForAStartThatIsVoidSaysNothing) {
    Bench bench;
    bench.run_bus_plan();
    bench.take(Start{bench.call(), false});
    const uint64_t load = bench.load, go = bench.go;
    bench.take(Stop{bench.call(), {"Ann"}});
    bench.take(Stopped{bench.stop, stood()});
    bench.take(PlanEnded{"Interrupted"});
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

}  // namespace
}  // namespace vagus::serve
