#include "embed/plan_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "toolbox/core.hpp"

namespace vagus::embed {
namespace {

using namespace std::chrono_literals;
using plan::Value;
using testing::HasSubstr;

// Doubles `n`.
constexpr std::string_view kDouble = R"({
  "format": "vagus-plan/1",
  "name": "Double",
  "configuration": {
    "n": { "type": "int", "access": "in" },
    "twice": { "type": "int", "access": "out" }
  },
  "start": { "actor": "double" },
  "actors": {
    "double": { "template": "Assign", "in": { "value": "2 * n" }, "out": { "result": "twice" },
      "states": { "Done": "@terminate" } }
  }
})";

// Waits for `go` on the bus, then until `far` is 0.
constexpr std::string_view kListen = R"({
  "format": "vagus-plan/1",
  "name": "Listen",
  "configuration": {
    "heard": { "type": "int", "initial": 0 },
    "far": { "type": "int", "initial": 5 }
  },
  "start": { "actor": "ear" },
  "actors": {
    "ear": { "template": "WaitForever", "supervisors": { "go": { "template": "OnEvent",
      "in": { "event": "'go'" }, "out": { "arg0": "heard" }, "events": { "Received": "rest" } } } },
    "rest": { "template": "Wait", "in": { "seconds": "far * 1000000" },
      "states": { "Done": "@terminate" },
      "supervisors": { "near": { "template": "Watch",
        "in": { "left": "far", "op": "'=='", "right": 0 }, "events": { "True": "@terminate" } } } }
  }
})";

class PlanRunTest : public testing::Test {
protected:
    PlanRunTest() { toolbox::add_core(library_); }
    LoadedPlan load(std::string_view text) const {
        return LoadedPlan::from_text(std::string(text), "test.plan.json", library_);
    }
    run::CodeLibrary library_;
};

TEST_F(PlanRunTest, APlanIsCalledLikeAFunction) {
    const Result<Called> called =
        call(load(kDouble), {{"n", Value(int64_t{21})}}, {.clock = Clock::Virtual});
    ASSERT_TRUE(called.ok()) << called.error().what;
    EXPECT_EQ(called.value().ended.result, plan::PlanResult::Ok);
    EXPECT_EQ(called.value().outputs.at("twice"), Value(int64_t{42}));
    EXPECT_EQ(called.value().outputs.size(), 1u);
}

TEST_F(PlanRunTest, ACallSaysWhatIsWrongWithItsInputs) {
    const LoadedPlan plan = load(kDouble);
    EXPECT_THAT(call(plan, {}).error().what, HasSubstr("the input \"n\" of the plan Double"));
    EXPECT_THAT(call(plan, {{"m", Value(true)}}).error().what, HasSubstr("no input \"m\""));
    EXPECT_THAT(call(plan, {{"twice", Value(true)}}).error().what, HasSubstr("no input \"twice\""));
    EXPECT_THAT(call(plan, {{"n", Value(std::string("x"))}}).error().what, HasSubstr("\"n\""));
}

TEST_F(PlanRunTest, ATextThatIsNoPlanIsReported) {
    const LoadedPlan plan = load("{ }");
    EXPECT_FALSE(plan.ok());
    EXPECT_THAT(plan.report(), HasSubstr("test.plan.json:1:1: error: "));
}

TEST_F(PlanRunTest, AReportNamesTheElementAndHoldsNothingThatATerminalObeys) {
    const std::string file = R"({ "format": "vagus-plan/1", "name": "P", "start": { "actor": "a" },
  "actors": {
    "a": { "template": "Wait", "in": { "seconds": "1 €" }, "states": { "Done": "\u001b[" } } } })";
    const LoadedPlan plan = load(file);
    EXPECT_EQ(
        plan.report(),
        "test.plan.json:3:40: error: a: the formula for \"seconds\": expected an operator or "
        "the end at position 3, found \"€\" [P8]\n"
        "test.plan.json:3:72: error: a: the state \"Done\" leads to \"\\u001b[\", which does not "
        "exist; there are a and @terminate [P17]\n");
}

// From a listener, and from another thread in real time: the event ends the first actor, the write
// is seen by the supervisor of the second.
TEST_F(PlanRunTest, ARunInRealTimeHearsIsWrittenAndRead) {
    PlanRun run(load(kListen));
    std::thread outside;
    run.listen([&](const plan::TraceEvent& event) {
        const auto* started = std::get_if<plan::ActorStarted>(&event.what);
        if (started && started->actor == "ear") {
            outside = std::thread([&run] { EXPECT_TRUE(run.hear({"go", {7}}).ok()); });
        }
        if (started && started->actor == "rest") {
            EXPECT_EQ(run.read("heard").value(), Value(int64_t{7}));
            EXPECT_TRUE(run.write("far", Value(int64_t{0})).ok());
        }
    });
    const run::Ended ended = run.run();
    outside.join();
    EXPECT_EQ(ended.result, plan::PlanResult::Interrupted);
    EXPECT_EQ(run.read("far").value(), Value(int64_t{0}));
    EXPECT_THAT(run.write("far", Value(int64_t{1})).error().what, HasSubstr("is over"));
}

TEST_F(PlanRunTest, InVirtualTimeAListenerWritesAndAborts) {
    for (const bool aborts : {false, true}) {
        PlanRun run(load(kListen), {.clock = Clock::Virtual, .max_time = 1s});
        ASSERT_TRUE(run.write("heard", Value(int64_t{3})).ok());
        run.listen([&run, aborts](const plan::TraceEvent& event) {
            const auto* started = std::get_if<plan::ActorStarted>(&event.what);
            if (!started || started->actor != "ear") return;
            EXPECT_TRUE(run.write("far", Value(2.5)).ok());
            if (aborts) run.abort();
        });
        const run::Ended ended = run.run();
        EXPECT_EQ(ended.result, plan::PlanResult::Interrupted);
        EXPECT_EQ(ended.timed_out, !aborts);
        EXPECT_EQ(run.read("heard").value(), Value(int64_t{3}));
        EXPECT_EQ(run.read("far").value(), Value(int64_t{3}));  // 2.5 rounds away from zero (P11)
    }
}

TEST_F(PlanRunTest, WhatCannotBeDoneIsAnError) {
    PlanRun run(load(kListen), {.clock = Clock::Virtual});
    EXPECT_THAT(run.read("near").error().what, HasSubstr("no variable \"near\""));
    EXPECT_THAT(run.write("far", Value(std::string("x"))).error().what, HasSubstr("\"far\""));
    EXPECT_THAT(run.hear({"go", {}}).error().what, HasSubstr("in real time"));
}

}  // namespace
}  // namespace vagus::embed
