// Stop: whom it reaches, in which order, and what "stopped" means.
#include "serve/target/stopping.hpp"

#include <gmock/gmock.h>

#include "serve/target/test_target.hpp"

namespace vagus::serve {
namespace {

using State = StopNode::State;
using Type = wire::MessageType;
using testing::Contains;

TEST_F(TargetTest, StopTellsAllBeforeItWritesAndReadsBackWhatItWrote) {
    run();
    stop();
    pass(200ms);
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(state_of(kDrive), State::Stopped);
    EXPECT_EQ(state_of(kBumper), State::Stopped);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
    EXPECT_EQ(node_document(kDrive)["stop"], "stopped");
    // Without what keeps time: who is there.
    std::vector<std::pair<uint16_t, Type>> sent;
    for (const wire::Frame& frame : bus.sent) {
        if (frame.type == 0xa011) continue;
        sent.emplace_back(frame.first_word(), static_cast<Type>(frame.type));
    }
    const std::vector<std::pair<uint16_t, Type>> expected = {{kDrive, Type::Stop},
                                                             {kBumper, Type::Stop},
                                                             {kDrive, Type::SetVariables},
                                                             {kDrive, Type::GetVariables},
                                                             {kDrive, Type::GetVariables}};
    ASSERT_GE(sent.size(), expected.size());
    sent.resize(expected.size());  // behind them: who is there, and who shares an id
    EXPECT_EQ(sent, expected);
}

// Who asked may be far away and see nothing of it.
TEST(StopAnswer, NamesAllThatWereNotReadBackAsStopped) {
    const StopReport report{{{1, "drive", State::Stopped},
                             {2, "bumper", State::Silent},
                             {3, "head", State::Gone},
                             {4, "", State::Moving}}};
    EXPECT_EQ(not_stopped(answer_of(report)),
              (std::vector<std::string>{"bumper", "head", "node 4"}));
}

// What was written is 0, and the wheel still turns.
TEST_F(TargetTest, ANodeThatAnsweredMovesUntilItsSpeedReadsZero) {
    run();
    bus.word(kDrive, "wheel.speed") = 30;
    stop();
    pass(kStopWithin - 20ms);
    EXPECT_FALSE(report.has_value());
    pass(40ms);
    EXPECT_EQ(state_of(kDrive), State::Moving);
    EXPECT_EQ(state_of(kBumper), State::Stopped);
    EXPECT_EQ(node_document(kDrive)["stop"], "moving");
    EXPECT_EQ(count_sent(kDrive, Type::Stop), 1u);
    EXPECT_LE(count_sent(kDrive, Type::GetVariables), 2u * 25u);  // each 50 ms, two variables
    bus.word(kDrive, "wheel.speed") = 0;
    pass(kMovesLongEvery + 100ms);
    EXPECT_EQ(node_document(kDrive)["stop"], "stopped");
}

TEST_F(TargetTest, ASilentNodeIsAskedEachSecondUntilItAnswers) {
    run();
    bus.mute(kDrive);
    stop();
    pass(kStopWithin - 20ms);
    EXPECT_TRUE(target.stop_report().nodes.empty());  // not before it is known
    pass(30ms);
    EXPECT_EQ(state_of(kDrive), State::Silent);
    EXPECT_EQ(state_of(kBumper), State::Stopped);
    EXPECT_EQ(target.stop_report().nodes.size(), 2u);
    EXPECT_EQ(node_document(kDrive)["stop"], "silent");
    pass(3s);
    EXPECT_THAT(count_sent(kDrive, Type::Stop), testing::AllOf(testing::Ge(4u), testing::Le(9u)));
    EXPECT_EQ(count_sent(kBumper, Type::Stop), 1u);
    bus.mute(kDrive, false);
    pass(2s);
    EXPECT_EQ(node_document(kDrive)["stop"], "stopped");
    const size_t before = count_sent(kDrive, Type::Stop);
    pass(5s);
    EXPECT_EQ(count_sent(kDrive, Type::Stop), before);
}

TEST_F(TargetTest, ASilentNodeThatAPersonKnowsOfIsAskedNoMore) {
    run();
    bus.mute(kDrive);
    stop();
    pass(2s);
    target.acknowledge_stop();
    const size_t before = count_sent(kDrive, Type::Stop);
    pass(3s);
    EXPECT_EQ(count_sent(kDrive, Type::Stop), before);
    EXPECT_FALSE(node_document(kDrive).contains("stop"));
}

class GoodbyeTest : public TargetTest {
protected:
    // Says good-bye, and nothing after it.
    void leave(uint16_t node) {
        wire::Frame goodbye;
        ASSERT_EQ(wire::encode_message(wire::Disconnected{}, node, goodbye), wire::Error::None);
        bus.mute(node);
        bus.others_say(goodbye);
        pass(20ms);
    }
};

// Nobody knows whether it is at rest; it is stopped when it is back.
TEST_F(GoodbyeTest, ANodeThatSaidGoodbyeIsNamedAndToldToStopUntilItIsBack) {
    run();
    leave(kDrive);
    EXPECT_THAT(target.problems(), Contains("drive is away"));
    stop();
    pass(100ms);
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(state_of(kDrive), State::Gone);
    EXPECT_EQ(not_stopped(answer_of(*report)), std::vector<std::string>{"drive"});
    const size_t before = count_sent(kDrive, Type::Stop);
    pass(1s);
    EXPECT_GT(count_sent(kDrive, Type::Stop), before);
    bus.mute(kDrive, false);
    pass(3s);
    EXPECT_EQ(node_document(kDrive)["stop"], "stopped");
    EXPECT_TRUE(not_stopped(answer_of(target.stop_report())).empty());
}

// Somebody has taken it off the robot.
TEST_F(GoodbyeTest, ANodeThatSaidGoodbyeIsNamedNoMoreOnceAPersonKnowsOfIt) {
    run();
    leave(kDrive);
    stop();
    pass(100ms);
    target.acknowledge_stop();
    report.reset();
    stop();
    pass(100ms);
    ASSERT_TRUE(report.has_value());
    EXPECT_TRUE(not_stopped(answer_of(*report)).empty());
}

// It was seen, and has not told what it is.
TEST_F(TargetTest, ANodeWithoutADescriptionIsToldToStop) {
    run();
    bus.add(3, "late");
    wire::Frame present;
    wire::NodePresent message{};
    message.version = 9;
    ASSERT_EQ(wire::encode_message(message, 3, present), wire::Error::None);
    bus.mute(3);
    bus.others_say(present);
    pass(20ms);
    stop();
    EXPECT_EQ(count_sent(3, Type::Stop), 1u);
    pass(kStopWithin + 10ms);
    EXPECT_EQ(state_of(3), State::Silent);
}

// Another program's events show that it is there; nobody has told that it answers.
TEST_F(TargetTest, AnIdThatWasOnlyHeardIsToldToStop) {
    run();
    wire::Frame event;
    event.source = 77;
    event.type = 5;
    event.size = 0;
    bus.others_say(event);
    pass(20ms);
    stop();
    EXPECT_EQ(count_sent(77, Type::Stop), 1u);
    pass(100ms);
    EXPECT_TRUE(report.has_value());
}

TEST_F(TargetTest, NothingThatWasAskedBeforeFollowsStop) {
    connect();
    bus.mute(kDrive);
    std::vector<std::string> failed;
    target.load_changed(true, [&](std::vector<std::string> why) { failed = std::move(why); });
    pass(100ms);
    bus.sent.clear();
    stop();
    pass(100ms);
    ASSERT_EQ(failed.size(), 1u);
    EXPECT_THAT(failed.front(), testing::HasSubstr("stopped before that was done"));
    bus.mute(kDrive, false);
    pass(5s);
    EXPECT_EQ(count_sent(kDrive, Type::Run), 0u);
    EXPECT_EQ(count_sent(kDrive, Type::SetBytecode), 0u);
    EXPECT_NE(node_document(kDrive)["program"], "current");
}

// 100,000 events in a second under the id of a node, from another program.
TEST_F(TargetTest, NoFloodUnderAnyIdKeepsStopFromANode) {
    for (const uint16_t id : {kDrive, kBumper, uint16_t{77}, uint16_t{0}}) {
        if (target.connected()) target.disconnect();
        run();
        wire::Frame event;
        event.source = id;
        event.type = 5;
        event.size = 0;
        stop();
        for (int i = 0; i < 100; ++i) {
            for (int k = 0; k < 1000; ++k) bus.others_say(event);
            pass(10ms);
        }
        pass(20ms);
        EXPECT_EQ(state_of(kDrive), State::Stopped) << "under the id " << id;
        EXPECT_EQ(state_of(kBumper), State::Stopped) << "under the id " << id;
        EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
    }
}

TEST_F(TargetTest, StopOfARobotThatWasLeftIsAnswered) {
    run();
    bus.mute(kDrive);
    stop();
    pass(20ms);
    target.disconnect();
    EXPECT_EQ(state_of(kDrive), State::Asked);
}

// ---- what was done behind Stop ----

// While the first node is still asked: what a person does then has to be stopped at the end.
TEST_F(TargetTest, WhatIsDoneWhileTheReportIsStillToComeIsNotForgottenByIt) {
    run();
    EXPECT_TRUE(target.moved());
    bus.mute(kBumper);
    stop();
    EXPECT_FALSE(target.moved());
    EXPECT_TRUE(target.quiet());
    pass(100ms);
    ask("node.run", {{"node", kDrive}});
    pass(kStopWithin);
    ASSERT_TRUE(report.has_value());
    EXPECT_TRUE(target.moved());
    EXPECT_FALSE(target.quiet());
}

// What makes nodes safe moves nothing, as often as it is written.
TEST_F(TargetTest, ARobotThatIsAskedOnWasNotMoved) {
    run();
    bus.mute(kDrive);
    stop();
    pass(5s);
    EXPECT_GE(count_sent(kDrive, Type::SetVariables), 2u);
    EXPECT_FALSE(target.moved());
}

TEST_F(TargetTest, ANodeThatComesBackIsNotKnownToBeAtRest) {
    run();
    stop();
    pass(200ms);
    EXPECT_TRUE(target.quiet());
    bus.mute(kDrive);
    pass(5s);
    bus.mute(kDrive, false);
    pass(3s);
    EXPECT_FALSE(target.quiet());
}

// ---- the link ----

TEST_F(TargetTest, ALinkThatIsHeldIsLostAndItsNodesAreSilent) {
    run();
    bus.frozen = true;
    pass(kLinkSilentMax - 1100ms);  // the last answer may be a second old
    EXPECT_EQ(target.state(), Connection::Connected);
    pass(1200ms);
    EXPECT_EQ(target.state(), Connection::Lost);
    stop();
    pass(kStopWithin + 10ms);
    EXPECT_EQ(state_of(kDrive), State::Silent);
    EXPECT_EQ(state_of(kBumper), State::Silent);
    bus.frozen = false;
    pass(2s);
    EXPECT_EQ(target.state(), Connection::Connected);
    EXPECT_EQ(node_document(kDrive)["stop"], "stopped");
}

// It is on our side of the link, and speaks each second.
TEST_F(TargetTest, WhatThePlansProcessSaysIsNoAnswerOfTheRobot) {
    run();
    wire::Frame alive;
    alive.source = wire::kHostId;
    alive.type = 5;
    alive.size = 0;
    bus.frozen = true;
    for (Duration passed{}; passed < kLinkSilentMax + 100ms; passed += 100ms) {
        bus.guest_says(alive);
        pass(100ms);
    }
    EXPECT_EQ(target.state(), Connection::Lost);
}

// We were suspended, or held by something else: nothing was asked meanwhile.
TEST_F(TargetTest, TimeInWhichWeWereLateIsNotTheSilenceOfALink) {
    run();
    bus.frozen = true;
    pass(1s);
    now += 60s;
    target.tick(now);
    EXPECT_EQ(target.state(), Connection::Connected);
    bus.frozen = false;
    pass(100ms);
    EXPECT_EQ(target.state(), Connection::Connected);
}

TEST_F(TargetTest, ALinkWithoutNodesMayBeSilent) {
    bus.frozen = true;
    target.connect(bus, "tcp:x", "x", "bus", now);
    pass(10s);
    EXPECT_EQ(target.state(), Connection::Connected);
}

}  // namespace
}  // namespace vagus::serve
