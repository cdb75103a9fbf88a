#include "session/node_commands.hpp"

#include <gmock/gmock.h>

#include <optional>

namespace vagus::session {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kDrives = "var n = 0\nmotor.left.target = 100\nonevent prox\nn += 1\n";

sim::Chaos unplugged_after(Duration from) {
    sim::Chaos chaos;
    chaos.faults.push_back(
        {.kind = sim::ChaosKind::Unplugged, .where = "thymio-II", .from = Time{from}});
    return chaos;
}

// A Thymio that runs a script, and who tells it what to do.
class NodeCommandsTest : public testing::Test {
protected:
    void open(const char* script = kDrives, sim::Chaos chaos = {}) {
        sim::WorldDefinition world;
        world.width = world.height = 4;
        sim::RobotDefinition robot;
        robot.name = "alice";
        robot.at = {2, 2};
        world.robots = {robot};
        SimOptions options;
        options.heard = true;
        sim::WorldOptions how;
        how.chaos = std::move(chaos);
        session_.emplace(std::move(sim::World::create(world, how).value()), options);
        commands_.emplace(*session_);
        session_->load("drives.aesl", script);
        pass(200ms);
        ASSERT_TRUE(session_->settled());
    }
    void pass(Duration span) {
        for (Duration passed{}; passed < span; passed += 1ms) {
            session_->step(1ms);
            for (const debug::Event& event : session_->take_heard()) commands_->hear(event);
            commands_->tick();
        }
    }
    void stop() {
        commands_->stop(shipped_safe_stop(), [this](const auto& nodes) { report_ = nodes; });
    }
    NodeCommands::Done told() {
        return [this](const std::string& why) { why_ = why; };
    }
    debug::ProgramState state() const { return session_->nodes().front().state; }
    int16_t value(const std::string& name) const {
        for (const auto& [known, values] : session_->script_variables(1)) {
            if (known == name) return values.front();
        }
        return session_->node_variable(sim::RobotId{1}, name).front();
    }

    std::optional<SimSession> session_;
    std::optional<NodeCommands> commands_;
    std::optional<std::vector<StopNode>> report_;
    std::optional<std::string> why_;
};

// A Thymio's motors keep their targets when its program is stopped.
TEST_F(NodeCommandsTest, StoppedMeansThatItsMotorsWereReadBackAtRest) {
    open();
    ASSERT_EQ(value("motor.left.target"), 100);
    stop();
    EXPECT_FALSE(report_);
    pass(100ms);
    ASSERT_TRUE(report_);
    ASSERT_EQ(report_->size(), 1u);
    EXPECT_EQ(report_->front().state, StopNode::State::Stopped);
    EXPECT_EQ(value("motor.left.target"), 0);
    EXPECT_EQ(state(), debug::ProgramState::Stopped);
}

TEST_F(NodeCommandsTest, ALoopThatNeverEndsIsStoppedAndTold) {
    open("var go = 0\nvar n = 0\nonevent prox\nwhile go == 0 do\nn += 1\nend\n");
    pass(300ms);
    EXPECT_THAT(session_->nodes().front().killed, HasSubstr("drives.aesl:"));
    EXPECT_THAT(session_->nodes().front().fault, IsEmpty());
    stop();
    pass(100ms);
    ASSERT_TRUE(report_);
    EXPECT_EQ(report_->front().state, StopNode::State::Stopped);
}

TEST_F(NodeCommandsTest, NothingThatIsLoadedRunsAfterStopBeforeItIsStarted) {
    open();
    stop();
    session_->reload("drives.aesl", "var n = 40\n");
    pass(500ms);
    EXPECT_NE(state(), debug::ProgramState::Running);
    commands_->start(told());
    pass(200ms);
    EXPECT_EQ(why_, "");
    EXPECT_EQ(state(), debug::ProgramState::Running);
    EXPECT_EQ(value("n"), 40);
}

TEST_F(NodeCommandsTest, WhatRunsIsLeftAloneByStartAndWhatWasStoppedBeginsAgain) {
    open();
    pass(1s);
    const int16_t before = value("n");
    ASSERT_GT(before, 5);
    commands_->start(told());
    pass(200ms);
    EXPECT_EQ(why_, "");
    EXPECT_GE(value("n"), before);
    stop();
    commands_->start(told());
    pass(200ms);
    EXPECT_LT(value("n"), before);
    EXPECT_EQ(value("motor.left.target"), 100);
}

TEST_F(NodeCommandsTest, APauseKeepsItsPlaceAndStopsItsMotors) {
    open();
    pass(1s);
    commands_->pause(shipped_safe_stop(), told());
    pass(300ms);
    EXPECT_EQ(why_, "");
    const int16_t before = value("n");
    EXPECT_EQ(value("motor.left.target"), 0);
    pass(500ms);
    EXPECT_EQ(value("n"), before);
    commands_->go_on(told());
    pass(300ms);
    EXPECT_GT(value("n"), before);
    commands_->go_on(told());
    EXPECT_EQ(why_, "it is not paused");
}

TEST_F(NodeCommandsTest, ANodeThatIsAwayIsSilentAndNeverAtRest) {
    open(kDrives, unplugged_after(300ms));
    pass(5s);
    stop();
    pass(1100ms);
    ASSERT_TRUE(report_);
    EXPECT_EQ(report_->front().name, "thymio-II");
    EXPECT_EQ(report_->front().state, StopNode::State::Silent);
    commands_->start(told());
    pass(6s);
    EXPECT_THAT(why_.value_or(""), HasSubstr("nothing started on alice: a node that is away"));
}

TEST_F(NodeCommandsTest, WhatIsWrongWithAVariableIsTold) {
    open();
    commands_->set("thymio-II", "n", {7}, told());
    EXPECT_FALSE(why_);
    pass(50ms);
    EXPECT_EQ(why_, "");
    commands_->set("thymio-II", "nn", {7}, told());
    EXPECT_THAT(why_.value_or(""), HasSubstr("nn"));
    commands_->set("thymio", "n", {7}, told());
    EXPECT_THAT(why_.value_or(""), HasSubstr("thymio"));
    commands_->set("thymio-II", "n", {7, 8}, told());
    EXPECT_EQ(why_, "n has 1 words; found 2 values");
}

TEST_F(NodeCommandsTest, WhoWaitsIsAnsweredWhenTheWorldBeginsAgain) {
    open(kDrives, unplugged_after(300ms));
    pass(5s);
    stop();
    commands_->begin_again();
    ASSERT_TRUE(report_);
    EXPECT_EQ(report_->front().state, StopNode::State::Silent);
}

// At the new start it is plugged in, and gets its script as soon as it is heard.
TEST_F(NodeCommandsTest, ANodeThatWasUnpluggedHasItsScriptWhenTheWorldBeginsAgain) {
    open(kDrives, unplugged_after(3s));
    pass(8s);
    session_->reset();
    commands_->begin_again();
    pass(2s);
    EXPECT_EQ(state(), debug::ProgramState::Running);
    EXPECT_EQ(value("motor.left.target"), 100);
    EXPECT_TRUE(session_->without_script().empty());
}

}  // namespace
}  // namespace vagus::session
