#include "debug/turns.hpp"

#include "debug/scripted_bus.hpp"

namespace vagus::debug {
namespace {

constexpr NodeId kFirst = 1;
constexpr auto kLast = static_cast<NodeId>(kTurnsAtOnce);

Turns full() {
    Turns turns;
    for (NodeId id = kFirst; id <= kLast; id++) EXPECT_TRUE(turns.enter(id, Time{}));
    return turns;
}

TEST(Turns, OneMoreThanTheLimitWaitsUntilSomebodyHasAnswered) {
    Turns turns = full();
    EXPECT_FALSE(turns.enter(100, Time{}));
    EXPECT_FALSE(turns.enter(101, Time{}));
    EXPECT_FALSE(turns.next(Time{}).has_value());
    turns.leave(7);
    EXPECT_EQ(turns.next(Time{}), 100);
    EXPECT_FALSE(turns.next(Time{}).has_value());
}

TEST(Turns, WhoComesWhileOthersWaitWaitsBehindThem) {
    Turns turns = full();
    EXPECT_FALSE(turns.enter(100, Time{}));
    turns.leave(1);
    EXPECT_FALSE(turns.enter(1, Time{}));
    EXPECT_EQ(turns.next(Time{}), 100);
    turns.leave(2);
    EXPECT_EQ(turns.next(Time{}), 1);
}

TEST(Turns, WhoIsOvertakenByLaterOnesKeepsNobodyWaitingForLong) {
    Turns turns = full();
    EXPECT_FALSE(turns.enter(100, Time{}));
    turns.progress(2, milliseconds(10));
    EXPECT_EQ(turns.next_tick(), kTurnFor);  // of node 1
    EXPECT_FALSE(turns.next(kTurnFor - Duration(1)).has_value());
    EXPECT_EQ(turns.next(kTurnFor), 100);
}

// A network that is slow as a whole is not asked more and more.
TEST(Turns, WhereNobodyAnswersTurnsLastLonger) {
    Turns turns = full();
    EXPECT_FALSE(turns.enter(100, Time{}));
    EXPECT_EQ(turns.next_tick(), kTurnForMax);
    EXPECT_FALSE(turns.next(kTurnForMax - Duration(1)).has_value());
    EXPECT_EQ(turns.next(kTurnForMax), 100);
}

TEST(Turns, WhoHasGoneWaitsNoLonger) {
    Turns turns = full();
    EXPECT_FALSE(turns.enter(100, Time{}));
    turns.leave(100);
    turns.leave(1);
    EXPECT_FALSE(turns.next(Time{}).has_value());
    EXPECT_EQ(turns.next_tick(), Time::max());
}

// ---- in a network of many nodes ----

void appear(ScriptedBus& bus, NodeId last) {
    for (NodeId id = kFirst; id <= last; id++) {
        wire::NodePresent present{};
        present.version = 5;
        bus.node_sends(id, present);
    }
}

TEST(ManyNodes, DescribeThemselvesInTurns) {
    ScriptedBus bus;
    appear(bus, 40);
    EXPECT_EQ(bus.sent().size(), kTurnsAtOnce);
    bus.describe_robot(1);  // the next is asked, and this one for its state
    EXPECT_EQ(bus.sent(), (Dumps{"02 00 00 00 07 a0 01 00", "04 00 00 00 10 a0 21 00 05 00"}));
    for (NodeId id = 2; id <= 40; id++) bus.describe_robot(id);
    EXPECT_EQ(bus.told<NodeDescribed>().size(), 40u);
}

TEST(ManyNodes, SilentOnesKeepTheOthersWaitingForAMoment) {
    ScriptedBus bus;
    appear(bus, 34);
    bus.describe_robot(2);  // node 33 is asked instead; node 1 was asked before, and is silent
    bus.sent();
    EXPECT_EQ(bus.network.next_tick(), Time{});  // ListNodes
    bus.pass(Duration(0));
    bus.sent();
    EXPECT_EQ(bus.network.next_tick(), kTurnFor);
    bus.pass(kTurnFor);
    EXPECT_EQ(bus.sent(), Dumps{"04 00 00 00 10 a0 22 00 05 00"});
}

TEST(ManyNodes, AreAskedToPauseInTurnsAndEachAnswers) {
    ScriptedBus bus;
    for (NodeId id = kFirst; id <= 40; id++) bus.meet_robot(id);
    for (NodeId id = kFirst; id <= 40; id++) ASSERT_TRUE(bus.network.pause(id).ok());
    EXPECT_EQ(bus.sent().size(), kTurnsAtOnce);
    for (NodeId id = kFirst; id <= 40; id++) bus.state(id, 0, wire::kFlagStep);
    EXPECT_EQ(bus.told<RequestDone>().size(), 40u);
    EXPECT_EQ(bus.sent().size(), 40 - kTurnsAtOnce);
}

TEST(Requests, WhatIsTheSameTwiceIsAskedAgainAfterASecond) {
    ScriptedBus bus;
    bus.meet_robot(1);
    ASSERT_TRUE(bus.network.pause(1).ok());
    const Dumps pause = {"02 00 00 00 04 a0 01 00"};
    EXPECT_EQ(bus.sent(), pause);
    bus.pass(kAskAgain - Duration(1));
    EXPECT_EQ(bus.sent(), Dumps{});
    bus.pass(Duration(1));
    EXPECT_EQ(bus.sent(), pause);
    bus.state(1, 0, wire::kFlagStep);
    ASSERT_EQ(bus.told<RequestDone>().size(), 1u);
    EXPECT_FALSE(bus.told<RequestDone>()[0].error.has_value());
}

TEST(Requests, AStepIsNotAskedAgain) {
    ScriptedBus bus;
    bus.meet_robot(1);
    bus.state(1, 5, wire::kFlagStep | wire::kFlagActive);
    ASSERT_TRUE(bus.network.step(1).ok());
    bus.state(1, 5, wire::kFlagStep | wire::kFlagActive);  // it says where it is paused
    bus.forget();
    bus.pass(kAskAgain);
    EXPECT_EQ(bus.sent(), Dumps{});
}

}  // namespace
}  // namespace vagus::debug
