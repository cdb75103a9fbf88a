#include "session/plan_world.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "plan/trace.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/core.hpp"

namespace vagus::session {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

// The Thymio answers `go` with one more; every 20 ms it emits how often it did.
constexpr std::string_view kScript = R"(<network>
<event size="1" name="go"/>
<event size="1" name="gone"/>
<event size="1" name="pulse"/>
<node nodeId="1" name="thymio-II">var pulses = 0
timer.period[0] = 20
onevent go
emit gone event.args[0] + 1
onevent timer0
pulses++
emit pulse pulses
</node></network>)";

constexpr std::string_view kWorld = R"({
  "format": "vagus-world/1", "name": "Room", "size": [1, 1],
  "robots": [{ "name": "thymio", "type": "thymio2", "at": [0.5, 0.5], "script": "answer.aesl" }]
})";

std::string plan(std::string_view actors) {
    return R"({ "format": "vagus-plan/1", "name": "P",
                "configuration": { "n": { "type": "int", "initial": 0 } },
                "start": { "actor": "a" }, "actors": {)" +
           std::string(actors) + "}}";
}

struct Ran {
    run::Ended ended;
    std::vector<std::string> trace;
    std::string all;  // both traces, in the order of what happened
};

class PlanWorldTest : public ::testing::Test {
protected:
    PlanWorldTest() { toolbox::add_core(library_); }

    Result<std::unique_ptr<PlanWorld>> open(std::string_view world, std::string_view script,
                                            PlanWorldOptions options = {}) {
        folder_.write("answer.aesl", script);
        options.path = folder_.write("room.world.json", world);
        options.traced = true;
        return PlanWorld::open(options, nodes_);
    }

    Ran run(std::string_view actors, std::string_view world = kWorld,
            const PlanWorldOptions& how = {}) {
        auto opened = open(world, kScript, how);
        EXPECT_TRUE(opened.ok()) << opened.error().what;
        PlanWorld& beside = *opened.value();
        const plan::Checked checked =
            plan::check("p.plan.json", plan::OneText(plan(actors)), library_.templates());
        EXPECT_TRUE(checked.ok()) << plan::format_findings_json(checked.findings);
        const plan::Graph graph = plan::make_graph(checked);
        Ran ran;
        run::RunOptions options;
        options.max_time = 10s;
        beside.join(options);
        options.on_trace = [&](const plan::TraceEvent& event) {
            ran.trace.push_back(plan::format_trace(event));
            ran.all += beside.session().take_trace() + ran.trace.back() + "\n";
        };
        ran.ended = run::VirtualTime(graph, library_, options).run();
        ran.all += beside.session().take_trace();
        return ran;
    }

    test::Folder folder_;
    run::CodeLibrary library_;
    toolbox::BusNodes nodes_;
};

// A plan that is being stopped may end its work, and begin none.
TEST_F(PlanWorldTest, WhatIsClosedLetsOnlyTheEventsOutThatWereNamed) {
    const auto opened = open(kWorld, kScript);
    ASSERT_TRUE(opened.ok()) << opened.error().what;
    PlanWorld& world = *opened.value();
    world.emit(0s, {"go", {1}});
    EXPECT_THAT(world.session().take_trace(), HasSubstr(R"("node":0,"name":"go")"));
    world.close_but_for({"pulse"});
    world.emit(0s, {"go", {1}});
    world.emit(0s, {"pulse", {1}});
    const std::string trace = world.session().take_trace();
    EXPECT_THAT(trace, testing::Not(HasSubstr(R"("name":"go")")));
    EXPECT_THAT(trace, HasSubstr(R"("node":0,"name":"pulse")"));
}

// Both have the nodes that the plan needs, and scripts that obey.
constexpr std::string_view kTwoRobots = R"({
  "format": "vagus-world/1", "name": "Room", "size": [2, 1], "robots": [
    { "name": "left", "type": "thymio2", "at": [0.5, 0.5], "node": 1, "script": "answer.aesl" },
    { "name": "right", "type": "thymio2", "at": [1.5, 0.5], "node": 2, "script": "answer.aesl" }]
})";
const std::vector<toolbox::NodeNames> kNeedsThymio = {{"drive", "thymio-II"}};

TEST_F(PlanWorldTest, OfTwoRobotsOneMustBeChosen) {
    const auto none = open(kTwoRobots, kScript, {.needs = kNeedsThymio});
    ASSERT_FALSE(none.ok());
    EXPECT_THAT(none.error().what, HasSubstr("could drive 2 robots of "));
    EXPECT_THAT(none.error().what, HasSubstr("left and right; choose one, as --robot left"));
    EXPECT_EQ(open(kWorld, kScript, {.needs = kNeedsThymio}).value()->robot(), sim::RobotId{1});
    EXPECT_EQ(open(kTwoRobots, kScript, {.robot = "right"}).value()->robot(), sim::RobotId{2});
    const auto unknown = open(kTwoRobots, kScript, {.robot = "rihgt"});
    ASSERT_FALSE(unknown.ok());
    EXPECT_THAT(unknown.error().what, HasSubstr("did you mean right?"));
    const auto lacking = open(kTwoRobots, kScript, {.robot = "left", .needs = {{"head"}}});
    ASSERT_FALSE(lacking.ok());
    EXPECT_THAT(lacking.error().what, HasSubstr("needs a node \"head\", and that robot has only "
                                                "thymio-II"));
}

// The right one answers go, the left one does not take it. Both emit pulse at 21 ms; of these the
// plan hears one, the other is not due before 41 ms.
TEST_F(PlanWorldTest, OnlyTheChosenRobotHearsAndIsHeard) {
    const Ran ran = run(R"(
        "a": { "template": "Send", "in": { "event": "'go'", "args": "'41'" },
               "states": { "Sent": "b" } },
        "b": { "template": "Receive", "in": { "event": "'pulse'" }, "states": { "Received": "c" } },
        "c": { "template": "Receive", "in": { "event": "'pulse'" }, "out": { "arg0": "n" },
               "states": { "Received": "@terminate" } })",
                        kTwoRobots, {.robot = "right", .needs = kNeedsThymio});
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Ok) << ran.ended.message;
    EXPECT_THAT(ran.all, HasSubstr(R"("node":2,"name":"gone","args":[42])"));
    EXPECT_THAT(ran.all, testing::Not(HasSubstr(R"("node":1,"name":"gone")")));
    EXPECT_THAT(ran.all, HasSubstr(R"("node":1,"name":"pulse")"));
    EXPECT_THAT(ran.trace.back(), HasSubstr(R"({"t":0.042000,)"));
}

// 0 ms: the plan emits go. 1 ms: the node hears it and answers. 2 ms: the plan hears that.
// The timer's period of 20 ms counts from its first look, at 1 ms: at 21 ms the node emits pulse,
// at 22 ms the plan hears it.
TEST_F(PlanWorldTest, APlanAndAScriptTalkAMillisecondEachWay) {
    const Ran ran = run(R"(
        "a": { "template": "Send", "in": { "event": "'go'", "args": "'41'" },
               "states": { "Sent": "b" } },
        "b": { "template": "Receive", "in": { "event": "'gone'" }, "out": { "arg0": "n" },
               "states": { "Received": "c" } },
        "c": { "template": "WaitForever", "supervisors": { "s": {
               "template": "OnEvent", "in": { "event": "'pulse'" }, "out": { "arg0": "n" },
               "events": { "Received": "@terminate" } } } })");
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Interrupted);
    EXPECT_EQ(ran.all,
              R"({"t":0.000000,"kind":"state","node":1,"state":"running"})"
              "\n"
              R"({"t":0.000000,"plan":"P","kind":"plan-start"})"
              "\n"
              R"({"t":0.000000,"plan":"P","kind":"write","variable":"n","value":0,)"
              R"("by":"initial"})"
              "\n"
              R"({"t":0.000000,"plan":"P","kind":"actor-start","actor":"a","activation":1,)"
              R"("in":{"event":"go","args":"41"}})"
              "\n"
              R"({"t":0.000000,"kind":"event","node":0,"name":"go","args":[41]})"
              "\n"
              R"({"t":0.000000,"plan":"P","kind":"actor-end","actor":"a","activation":1,)"
              R"("state":"Sent","target":"b"})"
              "\n"
              R"({"t":0.000000,"plan":"P","kind":"actor-start","actor":"b","activation":2,)"
              R"("in":{"event":"gone"}})"
              "\n"
              R"({"t":0.001000,"kind":"event","node":1,"name":"gone","args":[42]})"
              "\n"
              R"({"t":0.002000,"plan":"P","kind":"actor-end","actor":"b","activation":2,)"
              R"("state":"Received","target":"c"})"
              "\n"
              R"({"t":0.002000,"plan":"P","kind":"write","variable":"n","value":42,"by":"b"})"
              "\n"
              R"({"t":0.002000,"plan":"P","kind":"actor-start","actor":"c","activation":3,)"
              R"("in":{}})"
              "\n"
              R"({"t":0.021000,"kind":"event","node":1,"name":"pulse","args":[1]})"
              "\n"
              R"({"t":0.022000,"plan":"P","kind":"event","supervisor":"s","event":"Received",)"
              R"("target":"@terminate","global":false,"activation":3})"
              "\n"
              R"({"t":0.022000,"plan":"P","kind":"write","variable":"n","value":1,"by":"s"})"
              "\n"
              R"({"t":0.022000,"plan":"P","kind":"interrupted","actor":"c","activation":3,)"
              R"("ran":true,"stop_us":0})"
              "\n"
              R"({"t":0.022000,"plan":"P","kind":"plan-end","result":"Interrupted"})"
              "\n");
}

// What the plan emits between two milliseconds arrives at the second of them.
TEST_F(PlanWorldTest, BetweenTwoMillisecondsThePlanIsExact) {
    const Ran ran = run(R"(
        "a": { "template": "Wait", "in": { "seconds": 0.0025 }, "states": { "Done": "b" } },
        "b": { "template": "Send", "in": { "event": "'go'", "args": "'1'" },
               "states": { "Sent": "c" } },
        "c": { "template": "Receive", "in": { "event": "'gone'" },
               "states": { "Received": "@terminate" } })");
    EXPECT_THAT(ran.all, HasSubstr(R"({"t":0.002500,"kind":"event","node":0,"name":"go","args":[1]}
{"t":0.002500,"plan":"P","kind":"actor-end","actor":"b")"));
    EXPECT_THAT(ran.all, HasSubstr(R"({"t":0.003000,"kind":"event","node":1,"name":"gone")"));
    EXPECT_THAT(ran.all, HasSubstr(R"({"t":0.004000,"plan":"P","kind":"actor-end","actor":"c")"));
}

// The timeline is in seconds of the run: the button of 50 ms is pressed at 50 ms, and its event,
// which the script cannot hear before the next reading of the buttons, names no earlier time.
TEST_F(PlanWorldTest, TheTimelineCountsFromTimeZeroOfThePlan) {
    constexpr std::string_view kTimed = R"({
      "format": "vagus-world/1", "name": "Room", "size": [1, 1],
      "robots": [{ "name": "thymio", "type": "thymio2", "at": [0.5, 0.5],
                   "script": "answer.aesl" }],
      "timeline": [{ "t": 0.05, "do": "move", "id": "thymio", "at": [0.25, 0.75] }]
    })";
    const Ran ran = run(R"("a": { "template": "Wait", "in": { "seconds": 0.15 },
                                  "states": { "Done": "@terminate" } })",
                        kTimed);
    EXPECT_THAT(ran.all,
                HasSubstr(R"({"t":0.100000,"kind":"pose","robot":"thymio","x":0.25,"y":0.75,)"));
}

TEST_F(PlanWorldTest, ThePlanIsToldWhichNodesThereAre) {
    auto opened = open(kWorld, kScript);
    ASSERT_TRUE(opened.ok());
    EXPECT_TRUE(nodes_.has("thymio-II"));
    opened.value().reset();
    EXPECT_FALSE(nodes_.has("thymio-II"));
}

TEST_F(PlanWorldTest, AMistakeInAScriptRefusesTheRunWithTheCompilersSentence) {
    const auto opened = open(kWorld, R"(<network>
<node nodeId="1" name="thymio-II">var n
m = 3
</node></network>)");
    ASSERT_FALSE(opened.ok());
    EXPECT_THAT(opened.error().what, HasSubstr("answer.aesl:3:1: error: "));
}

TEST_F(PlanWorldTest, AWrongWorldNamesFileLineAndElement) {
    const auto opened = open(R"({
  "format": "vagus-world/1", "name": "Room", "size": [1, 1],
  "robots": [{ "name": "thymio", "type": "thymi", "at": [0.5, 0.5] }]
})",
                             kScript);
    ASSERT_FALSE(opened.ok());
    EXPECT_THAT(opened.error().what, HasSubstr("room.world.json:3:"));
    EXPECT_THAT(opened.error().what, HasSubstr("thymi"));
}

// One plan on one bus cannot say `go` to two robots for which it has two numbers.
TEST_F(PlanWorldTest, TwoProjectsThatNumberAnEventDifferentlyAreRefused) {
    folder_.write("other.aesl", R"(<network><event size="1" name="halt"/>
<event size="1" name="go"/><node nodeId="2" name="thymio-II"></node></network>)");
    const auto opened = open(R"({
      "format": "vagus-world/1", "name": "Room", "size": [2, 1],
      "robots": [
        { "name": "a", "type": "thymio2", "at": [0.5, 0.5], "node": 1, "script": "answer.aesl" },
        { "name": "b", "type": "thymio2", "at": [1.5, 0.5], "node": 2, "script": "other.aesl" }]
    })",
                             kScript);
    ASSERT_FALSE(opened.ok());
    EXPECT_THAT(opened.error().what, HasSubstr("event 0 is \"halt\" here and \"go\" in"));
}

TEST_F(PlanWorldTest, AnEventThatNoProjectDeclaresEndsThePlanWithAnError) {
    const Ran ran = run(R"(
        "a": { "template": "Send", "in": { "event": "'g' & n" },
               "states": { "Sent": "@terminate" } })");
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(ran.ended.message,
                HasSubstr("the event \"g0\" has no number: it is not declared by "));
}

TEST_F(PlanWorldTest, TheSameRunTwiceGivesTheSameBytes) {
    constexpr std::string_view kActors = R"(
        "a": { "template": "Send", "in": { "event": "'go'", "args": "n" },
               "states": { "Sent": "b" } },
        "b": { "template": "Receive", "in": { "event": "'gone'" }, "out": { "arg0": "n" },
               "states": { "Received": "c" } },
        "c": { "template": "Compare", "in": { "left": "n", "op": "'<'", "right": 500 },
               "states": { "True": "a", "False": "@terminate" } })";
    const Ran first = run(kActors);
    const Ran second = run(kActors);
    EXPECT_EQ(first.ended.result, plan::PlanResult::Ok);
    EXPECT_EQ(first.all, second.all);
    // Two milliseconds a round, 500 rounds.
    EXPECT_THAT(first.trace.back(), HasSubstr(R"("t":1.000000,"plan":"P","kind":"plan-end")"));
}

}  // namespace
}  // namespace vagus::session
