#include "embed/robots_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/test_folder.hpp"

namespace vagus::embed {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

// Answers `go` with one more.
constexpr std::string_view kScript = R"(<network>
<event size="1" name="go"/>
<event size="1" name="gone"/>
<node nodeId="1" name="thymio-II">onevent go
emit gone event.args[0] + 1
</node></network>)";

// Counts to 3 together with the robot, then waits, so that it ends after one second.
constexpr std::string_view kPlan = R"({
  "format": "vagus-plan/1", "name": "Count",
  "configuration": { "n": { "type": "int", "initial": 0 } },
  "start": { "actor": "ask" },
  "actors": {
    "ask": { "template": "Send", "in": { "event": "'go'", "args": "n" },
             "states": { "Sent": "hear" } },
    "hear": { "template": "Receive", "in": { "event": "'gone'" }, "out": { "arg0": "n" },
              "states": { "Received": "more" } },
    "more": { "template": "Compare", "in": { "left": "n", "op": "'<'", "right": 3 },
              "states": { "True": "ask", "False": "rest" } },
    "rest": { "template": "Wait", "in": { "seconds": 1 }, "states": { "Done": "@terminate" } }
  }
})";

class RobotsRunTest : public testing::Test {
protected:
    void project(const std::string& name, const std::string& members, std::string_view script) {
        folder_.write(name + "/vagus.json", R"({"format":"vagus-project/1",)" + members + "}");
        folder_.write(name + "/s.aesl", script);
        folder_.write(name + "/p.plan.json", kPlan);
    }
    std::string world(const std::string& members) {
        return folder_.write("w.world.json",
                             R"({"format":"vagus-world/1","size":[3,3],)" + members + "}");
    }
    std::string error_of(const std::string& members) {
        auto opened = RobotsRun::open({.world = world(members)});
        if (!opened.ok()) return opened.error().what;
        const Status begun = opened.value()->start();
        return begun.ok() ? "" : begun.error().what;
    }
    // The trace of a run.
    std::string traced(const std::string& members, Duration span) {
        RobotsOptions options{.world = world(members)};
        options.sim.traced = true;
        auto opened = RobotsRun::open(options);
        EXPECT_TRUE(opened.ok()) << opened.error().what;
        if (!opened.ok()) return "";
        RobotsRun& run = *opened.value();
        const Status begun = run.start();
        EXPECT_TRUE(begun.ok()) << begun.error().what;
        run.step(span);
        run.end();
        failed_ = run.has_failed();
        return run.buses().take_trace();
    }

    test::Folder folder_;
    bool failed_ = false;
};

constexpr const char* kTwo = R"("robots":[
    {"name":"a","type":"thymio2","at":[1,1],"project":"counts"},
    {"name":"b","type":"thymio2","at":[2,1],"project":"counts"}])";
constexpr const char* kWithPlan = R"("plan":"p.plan.json","scripts":["s.aesl"])";

// Sent at 0, on the bus at 1 ms, heard by the node and answered at 1 ms, heard by the plan at 2 ms.
TEST_F(RobotsRunTest, EachRobotHasItsPlanOnItsOwnBusAndAllAreInOneTrace) {
    project("counts", kWithPlan, kScript);
    const std::string trace = traced(kTwo, 2s);
    for (const std::string robot : {"a", "b"}) {
        EXPECT_THAT(trace, HasSubstr(R"({"t":0.000000,"robot":")" + robot +
                                     R"(","plan":"Count","kind":"plan-start"})"));
        EXPECT_THAT(trace, HasSubstr(R"({"t":0.001000,"kind":"event","robot":")" + robot +
                                     R"(","node":1,"name":"gone","args":[1]})"));
        EXPECT_THAT(trace, HasSubstr(R"({"t":1.006000,"robot":")" + robot +
                                     R"(","plan":"Count","kind":"plan-end","result":"OK"})"));
    }
    EXPECT_LT(trace.find(R"("args":[2]})"), trace.find(R"("args":[3]})"));
    EXPECT_FALSE(failed_);
    EXPECT_EQ(trace, traced(kTwo, 2s));
}

TEST_F(RobotsRunTest, TheEndOfARunInterruptsPlans) {
    project("counts", kWithPlan, kScript);
    const std::string trace = traced(kTwo, 500ms);
    EXPECT_THAT(trace, HasSubstr(R"("kind":"plan-end","result":"Interrupted")"));
    EXPECT_THAT(trace, Not(HasSubstr(R"("result":"OK")")));
}

TEST_F(RobotsRunTest, ASecondRunIsTheFirstAgain) {
    project("counts", kWithPlan, kScript);
    RobotsOptions options{.world = world(kTwo)};
    options.sim.traced = true;
    auto opened = RobotsRun::open(options);
    ASSERT_TRUE(opened.ok()) << opened.error().what;
    RobotsRun& run = *opened.value();
    ASSERT_TRUE(run.start().ok());
    run.step(1500ms);
    (void)run.buses().take_trace();
    ASSERT_TRUE(run.restart().ok());
    run.step(1500ms);
    const std::string again = run.buses().take_trace();
    EXPECT_THAT(again, HasSubstr(R"({"t":1.006000,"robot":"b","plan":"Count","kind":"plan-end")"));
}

TEST_F(RobotsRunTest, RobotsWithoutProjectsShareTheCommonBusBesideThem) {
    project("counts", kWithPlan, kScript);
    folder_.write("s.aesl", kScript);
    const std::string trace = traced(R"("robots":[
        {"name":"a","type":"thymio2","at":[1,1],"project":"counts"},
        {"name":"c","type":"thymio2","at":[2,1],"script":"s.aesl"}])",
                                     100ms);
    // The plan of the other robot is not heard there.
    EXPECT_THAT(trace, Not(HasSubstr(R"("kind":"event","node":1)")));
    EXPECT_THAT(trace, HasSubstr(R"({"t":0.100000,"kind":"pose","robot":"c")"));
}

TEST_F(RobotsRunTest, WhatIsWrongNamesTheRobotAndTheFile) {
    EXPECT_THAT(error_of(R"("robots":[{"name":"a","type":"thymio2","at":[1,1],"project":"no"}])"),
                HasSubstr("robots[0].project: "));
    project("outside", kWithPlan, "<network></network>");
    EXPECT_THAT(
        error_of(R"("robots":[{"name":"a","type":"thymio2","at":[1,1],"project":"outside"}])"),
        HasSubstr("its plan names events that its bus does not have"));
    project("set", std::string(kWithPlan) + R"(,"start":{"set":{"m":1}})", kScript);
    EXPECT_THAT(error_of(R"("robots":[{"name":"a","type":"thymio2","at":[1,1],"project":"set"}])"),
                HasSubstr("robot a: "));
    project("fleet", R"("fleet":{"name":"f"})", kScript);
    EXPECT_THAT(
        error_of(R"("robots":[{"name":"all","type":"thymio2","at":[1,1],"project":"fleet"}])"),
        HasSubstr("cannot be the name of a robot in a fleet"));
}

// ---- the fleet ----

// Says `alarm` once, 400 ms after the start if it is the first: that one has node 2.
std::string alarm_script(int period) {
    return "<network>\n<event size=\"1\" name=\"alarm\"/>\n<event size=\"1\" name=\"heard\"/>\n"
           "<node nodeId=\"1\" name=\"thymio-II\">timer.period[0] = " +
           std::to_string(period) +
           "\nonevent timer0\ntimer.period[0] = 0\nemit alarm 5\nonevent alarm\n"
           "emit heard event.args[0]\n</node></network>";
}

constexpr const char* kFleet = R"("scripts":["s.aesl"],
    "fleet":{"name":"f","send":["alarm"],"hear":["alarm"]})";
constexpr const char* kCaller = R"({"name":"a","type":"thymio2","at":[1,1],"project":"calls"},
    {"name":"b","type":"thymio2","at":[2,1],"project":"hears"},
    {"name":"c","type":"thymio2","at":[2,2],"project":"hears"}])";

size_t count(const std::string& text, const std::string& what) {
    size_t times = 0;
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
        ++times;
    }
    return times;
}

TEST_F(RobotsRunTest, AnEventOfTheFleetRunsInTheScriptsOfAllOthersOnce) {
    project("calls", kFleet, alarm_script(400));
    project("hears", kFleet, alarm_script(0));
    const std::string trace = traced(R"("robots":[)" + std::string(kCaller), 2s);
    EXPECT_EQ(count(trace, R"("name":"heard","args":[5])"), 2u);
    EXPECT_THAT(trace, Not(HasSubstr(R"("robot":"a","node":1,"name":"heard")")));
    // Timer at 400 ms, told to the fleet at 401 ms, two ways of 5 ms, then onto the bus.
    EXPECT_THAT(trace,
                HasSubstr(R"("kind":"event","robot":"b","node":0,"name":"alarm","args":[5]})"));
}

TEST_F(RobotsRunTest, LossTwiceAndJitterChangeWhenButNotHowOften) {
    project("calls", kFleet, alarm_script(400));
    project("hears", kFleet, alarm_script(0));
    const std::string members =
        R"("fleet":{"latency":0.01,"jitter":0.1,"loss":0.4,"twice":0.5},"robots":[)" +
        std::string(kCaller);
    const std::string trace = traced(members, 8s);
    EXPECT_EQ(count(trace, R"("name":"heard","args":[5])"), 2u);
    EXPECT_EQ(trace, traced(members, 8s));
}

TEST_F(RobotsRunTest, ARobotThatIsCutOffStopsAsItsProjectSays) {
    project("calls", kFleet, alarm_script(400));
    project("hears", kFleet, alarm_script(0));
    // Cut at 1 s, missed 7.5 s later, and after 5 s more it stops.
    const std::string trace = traced(
        R"("timeline":[{"t":1,"do":"cut","robot":"b"}],"robots":[)" + std::string(kCaller), 14s);
    EXPECT_THAT(trace,
                HasSubstr(R"({"t":13.500000,"kind":"fleet","robot":"b","text":"not in the fleet)"));
    EXPECT_THAT(trace, HasSubstr(R"("kind":"state","robot":"b","node":1,"state":"stopped"})"));
    EXPECT_THAT(trace, Not(HasSubstr(R"("robot":"c","text":"not in)")));
}

}  // namespace
}  // namespace vagus::embed
