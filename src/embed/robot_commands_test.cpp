#include "embed/robot_commands.hpp"

#include <gmock/gmock.h>

#include "base/test_folder.hpp"
#include "embed/robots_run.hpp"

namespace vagus::embed {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view kCounting = R"(<network>
<event size="1" name="go"/>
<node nodeId="1" name="thymio-II">var n
onevent prox
n += 1
</node></network>)";

// Ends after one second of its own clock, or as soon as its supervisor hears `go`.
constexpr std::string_view kRest = R"({
  "format": "vagus-plan/1", "name": "Rest",
  "configuration": { "n": { "type": "int", "initial": 0 } },
  "start": { "actor": "rest" },
  "actors": {
    "rest": { "template": "Wait", "in": { "seconds": 1 }, "states": { "Done": "@terminate" },
              "supervisors": { "ear": { "template": "OnEvent", "in": { "event": "'go'" },
                                        "out": { "arg0": "n" },
                                        "events": { "Received": "more" } } } },
    "more": { "template": "Wait", "in": { "seconds": 5 }, "states": { "Done": "@terminate" } }
  }
})";

// One robot of a world, and what it is told.
class RobotCommandsTest : public testing::Test {
protected:
    void open(const std::string& members, std::string_view script = kCounting) {
        folder_.write("p/vagus.json", R"({"format":"vagus-project/1",)" + members + "}");
        folder_.write("p/s.aesl", script);
        folder_.write("p/p.plan.json", kRest);
        RobotsOptions options{
            .world = folder_.write("w.world.json",
                                   R"({"format":"vagus-world/1","size":[3,3],"robots":[)"
                                   R"({"name":"a","type":"thymio2","at":[1,1],"project":"p"}]})")};
        options.sim.traced = true;
        auto opened = RobotsRun::open(options);
        ASSERT_TRUE(opened.ok()) << opened.error().what;
        run_ = std::move(opened.value());
        ASSERT_TRUE(run_->start().ok());
    }
    // The answer, which is to come within 100 ms.
    std::string obey(const fleet::Command& command) {
        std::optional<fleet::Answer> answer;
        run_->commands(0).obey(command, [&answer](fleet::Answer told) { answer = told; });
        run_->step(100ms);
        if (!answer) return "no answer";
        return answer->done ? "done" : answer->what;
    }
    std::string state() const { return run_->commands(0).shown().state; }
    int16_t n() const { return run_->commands(0).values({"thymio-II", "n"}).value().front(); }

    test::Folder folder_;
    std::unique_ptr<RobotsRun> run_;
};

constexpr const char* kWithRest = R"("plan":"p.plan.json","scripts":["s.aesl"])";
constexpr const char* kWithoutPlan = R"("scripts":["s.aesl"])";

TEST_F(RobotCommandsTest, APauseStopsTheClockOfThePlanAndTheScripts) {
    open(kWithRest);
    run_->step(500ms);
    EXPECT_EQ(obey({.verb = "pause"}), "done");
    EXPECT_EQ(state(), "paused");
    const int16_t before = n();
    run_->step(1900ms);
    EXPECT_EQ(state(), "paused");
    EXPECT_EQ(n(), before);
    EXPECT_EQ(obey({.verb = "continue"}), "done");
    EXPECT_EQ(state(), "running");
    run_->step(1s);
    EXPECT_GT(n(), before);
    // 1 s of its own, of which 2 s of the world were none.
    EXPECT_THAT(run_->buses().take_trace(),
                HasSubstr(R"({"t":3.000000,"robot":"a","plan":"Rest","kind":"plan-end")"));
    EXPECT_EQ(obey({.verb = "continue"}), "it is not paused");
}

TEST_F(RobotCommandsTest, StartContinuesAPlanThatIsPausedAndStopEndsIt) {
    open(kWithRest);
    EXPECT_EQ(obey({.verb = "pause"}), "done");
    EXPECT_EQ(obey({.verb = "start"}), "done");
    EXPECT_EQ(state(), "running");
    EXPECT_EQ(obey({.verb = "pause"}), "done");
    run_->commands(0).obey({.verb = "stop"}, [](const fleet::Answer&) {});
    run_->step(200ms);
    EXPECT_EQ(state(), "stopped");
    EXPECT_THAT(run_->buses().take_trace(),
                HasSubstr(R"("plan":"Rest","kind":"plan-end","result":"Interrupted")"));
}

// What comes while it is paused waits for it.
TEST_F(RobotCommandsTest, AnEventThatComesDuringAPauseIsHeardAfterIt) {
    open(kWithRest);
    run_->step(100ms);
    EXPECT_EQ(obey({.verb = "pause"}), "done");
    EXPECT_EQ(obey({.verb = "emit", .event = "go", .values = {7}}), "done");
    run_->step(1s);
    EXPECT_EQ(run_->commands(0).shown().actor, "rest");
    EXPECT_EQ(obey({.verb = "continue"}), "done");
    EXPECT_EQ(run_->commands(0).shown().actor, "more");
}

TEST_F(RobotCommandsTest, AVariableOfAPlanIsSetAlsoWhileItIsPaused) {
    open(kWithRest);
    EXPECT_EQ(obey({.verb = "pause"}), "done");
    EXPECT_EQ(obey({.verb = "set", .name = "n", .values = {7}}), "done");
    const plan::WordFormula::Name name{
        .shown = "n", .of = plan::WordFormula::Name::Of::Variable, .variable = "n"};
    EXPECT_EQ(run_->commands(0).read(name).value(), plan::Value(int64_t{7}));
}

TEST_F(RobotCommandsTest, AnEventOfASupervisorIsRaised) {
    open(kWithRest);
    EXPECT_THAT(obey({.verb = "raise", .supervisor = "eye", .event = "Received"}),
                HasSubstr("eye"));
    EXPECT_THAT(obey({.verb = "raise", .supervisor = "ear", .event = "Gone"}), HasSubstr("Gone"));
    EXPECT_EQ(run_->commands(0).shown().actor, "rest");
    EXPECT_EQ(obey({.verb = "raise", .supervisor = "ear", .event = "Received"}), "done");
    EXPECT_EQ(run_->commands(0).shown().actor, "more");
    EXPECT_EQ(obey({.verb = "dance"}), "dance is no command of this version");
}

TEST_F(RobotCommandsTest, WithoutAPlanNothingIsRaised) {
    open(kWithoutPlan);
    EXPECT_EQ(obey({.verb = "raise", .supervisor = "ear", .event = "Received"}), "no plan runs");
}

// Who sets it is nowhere that anybody would miss them: it would drive for ever.
TEST_F(RobotCommandsTest, WhatDrivesARobotIsNotSetFromAfar) {
    open(kWithoutPlan);
    const fleet::Command set{
        .verb = "set", .node = "thymio-II", .name = "motor.left.target", .values = {100}};
    EXPECT_EQ(obey({.verb = "stop"}), "done");
    EXPECT_THAT(obey(set), HasSubstr("motor.left.target drives the robot, and would go on"));
    fleet::Command rest = set;
    rest.values = {0};
    EXPECT_EQ(obey(rest), "done");
    fleet::Command other = set;
    other.name = "n";
    EXPECT_EQ(obey(other), "done");
}

// It was stopped like all others; what it did wrong is told until it runs again.
TEST_F(RobotCommandsTest, AFaultIsOverWhenItsRobotIsStopped) {
    open(kWithoutPlan,
         "<network>\n<node nodeId=\"1\" name=\"thymio-II\">var a[2]\nvar i = 5\n"
         "onevent prox\na[i] = 1\n</node></network>");
    run_->step(1s);
    EXPECT_EQ(state(), "fault");
    EXPECT_EQ(obey({.verb = "stop"}), "done");
    EXPECT_EQ(state(), "stopped");
    EXPECT_THAT(run_->commands(0).shown().problems, ElementsAre(HasSubstr("s.aesl:5")));
    EXPECT_EQ(obey({.verb = "start"}), "done");
    run_->step(1s);
    EXPECT_EQ(state(), "fault");
}

// It is in what runs at the start, and no event ends it: the node itself tells nothing.
TEST_F(RobotCommandsTest, ALoopThatNoEventEndsIsAFaultAtItsLine) {
    open(kWithoutPlan,
         "<network>\n<node nodeId=\"1\" name=\"thymio-II\">var go = 0\n"
         "while go == 0 do\ngo = 0\nend\n</node></network>");
    run_->step(session::kEndlessAfter - 100ms);
    EXPECT_EQ(state(), "running");
    run_->step(200ms);
    const fleet::Shown shown = run_->commands(0).shown();
    EXPECT_THAT(shown.nodes, ElementsAre("thymio-II"));
    EXPECT_EQ(shown.state, "fault");
    EXPECT_THAT(shown.problems, ElementsAre(testing::MatchesRegex(
                                    "thymio-II: s.aesl:[345]: what it does at an event does not "
                                    "end; it may be in an endless loop")));
    EXPECT_EQ(obey({.verb = "stop"}), "done");
    EXPECT_EQ(state(), "stopped");
}

}  // namespace
}  // namespace vagus::embed
