#include "fleet/test_member.hpp"

#include <algorithm>

namespace vagus::fleet {
namespace {

using Texts = std::vector<std::string>;
const ProjectPart kAlarm{.groups = {"red"}, .send = {"alarm"}, .hear = {{"alarm", ""}}};

TEST(MemberShows, ItsNodesInItsDescription) {
    MemberCase c;
    c.hold();
    // Two of one name are one word for whoever sets a variable; none can be longer than a name.
    c.member.show({.nodes = {"thymio-II", "arm", "thymio-II", "", std::string(65, 'x')}}, c.now);
    c.tick(kStateEveryMin);
    ASSERT_EQ(c.published<Description>().size(), 1u);
    EXPECT_EQ(c.published<Description>()[0].nodes, (Texts{"thymio-II", "arm"}));
    EXPECT_EQ(c.published<Description>()[0].project, "Alarm");
    // Told again when they change, not with each state.
    c.member.show({.state = "running", .nodes = {"thymio-II", "arm"}}, c.now);
    c.tick(c.now + kStateEveryMin);
    c.tick(c.now + kStateEveryMax);
    EXPECT_EQ(c.published<Description>().size(), 1u);
    c.member.show({.state = "running", .nodes = {"thymio-II"}}, c.now);
    c.tick(c.now + kStateEveryMin);
    ASSERT_EQ(c.published<Description>().size(), 2u);
    EXPECT_EQ(c.published<Description>()[1].nodes, Texts{"thymio-II"});
}

TEST(MemberShows, NoMoreNodesThanADescriptionHolds) {
    MemberCase c;
    std::vector<std::string> nodes;
    for (size_t i = 0; i <= kNodesMax; i++) nodes.push_back("n" + std::to_string(i));
    c.hold();
    c.member.show({.nodes = nodes}, c.now);
    c.tick(kStateEveryMin);
    ASSERT_EQ(c.published<Description>().size(), 1u);
    EXPECT_EQ(c.published<Description>()[0].nodes.size(), 128u);
    EXPECT_EQ(c.published<Description>()[0].nodes.back(), "n127");
}

// ---- without a broker ----

TEST(MemberAlone, ARobotStopsAfterFiveSeconds) {
    MemberCase c;
    c.hold();
    c.now = 10s;
    c.hear(Lost{"gone"});
    EXPECT_EQ(c.member.next_tick(), 15s);
    c.tick(15s - 1us);
    EXPECT_TRUE(c.all<StopAlone>().empty());
    c.tick(15s);
    c.tick(16s);
    EXPECT_EQ(c.all<StopAlone>().size(), 1u);
}

TEST(MemberAlone, AlsoOneThatWasNeverInTheFleet) {
    MemberCase c;
    c.tick(kBrokerLostAfter);
    EXPECT_EQ(c.all<StopAlone>().size(), 1u);
}

TEST(MemberAlone, OneThatIsBackInTimeGoesOn) {
    MemberCase c;
    c.hold();
    c.hear(Lost{"gone"});
    c.now = 4s;
    c.hold();
    c.tick(8s);
    EXPECT_TRUE(c.all<StopAlone>().empty());
}

TEST(MemberAlone, TheProjectMaySayThatItContinues) {
    MemberCase c({.broker_lost = BrokerLost::Continue});
    c.tick(kBrokerLostAfter);
    EXPECT_TRUE(c.all<StopAlone>().empty());
    EXPECT_EQ(c.all<Say>().size(), 1u);
}

TEST(MemberAlone, TheSameTroubleIsToldOnce) {
    MemberCase c;
    c.hear(Lost{"refused"});
    c.hear(Lost{"refused"});
    EXPECT_EQ(c.all<Say>().size(), 1u);
}

// ---- events ----

TEST(MemberEvents, WhatIsListedIsSent) {
    MemberCase c(kAlarm);
    c.hold();
    c.member.emitted("alarm", {1, 2}, 0s);
    c.member.emitted("other", {}, 0s);
    c.take();
    const auto sent = c.published<Event>();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(sent[0].args, (std::vector<int16_t>{1, 2}));
    EXPECT_EQ(sent[0].groups, Texts{"red"});
    EXPECT_EQ(sent[0].epoch, 7);
    EXPECT_EQ(c.all<Post>()[0].topic, "vagus/1/lab/robot/r1/event/alarm");
    EXPECT_FALSE(c.all<Post>()[0].retained);
}

TEST(MemberEvents, WhatIsListedIsHeardOnce) {
    MemberCase c(kAlarm);
    c.hold();
    c.event("r2", {1, 3, {}, {5}});
    c.event("r2", {1, 3, {}, {5}});
    c.event("r2", {2, 3, {}, {}}, "other");
    ASSERT_EQ(c.all<EmitOnBus>().size(), 1u);
    EXPECT_EQ(c.all<EmitOnBus>()[0].event, "alarm");
    EXPECT_EQ(c.all<EmitOnBus>()[0].args, (std::vector<int16_t>{5}));
    EXPECT_EQ(c.all<EmitOnBus>()[0].from, "r2");
}

TEST(MemberEvents, ItsOwnAreNeverHeard) {
    MemberCase c(kAlarm);
    c.hold();
    c.event("r1", {1, 7, {}, {}});
    EXPECT_TRUE(c.all<EmitOnBus>().empty());
}

TEST(MemberEvents, NothingGoesRound) {
    MemberCase c(kAlarm);
    c.hold();
    c.event("r2", {1, 3, {}, {}});
    EXPECT_TRUE(c.published<Event>().empty());
}

TEST(MemberEvents, OnlyThoseOfTheGroupThatIsNamed) {
    MemberCase c({.hear = {{"alarm", "red"}}});
    c.hold();
    c.event("r2", {1, 3, {"blue"}, {}});
    EXPECT_TRUE(c.all<EmitOnBus>().empty());
    c.event("r2", {2, 3, {"blue", "red"}, {}});
    EXPECT_EQ(c.all<EmitOnBus>().size(), 1u);
}

TEST(MemberEvents, AtMostTwentyASecondAreSentAndTwoHundredInTenSecondsHeard) {
    MemberCase c(kAlarm);
    c.hold();
    for (int64_t i = 1; i <= 21; ++i) {
        c.member.emitted("alarm", {}, 0s);
        c.take();
        const auto posts = c.all<Post>();
        if (!posts.empty()) c.hear(Acknowledged{posts.back().number});
    }
    for (int64_t i = 1; i <= 201; ++i) c.event("r2", {i, 3, {}, {}});
    EXPECT_EQ(c.published<Event>().size(), 20u);
    EXPECT_EQ(c.all<EmitOnBus>().size(), 200u);
    EXPECT_EQ(c.member.left_out(), 2u);
}

// A broker keeps what comes for a member that was cut off, and gives it as soon as it is there
// again: before it is known whether the name is still ours.
TEST(MemberEvents, ThoseThatComeBeforeTheNameIsOursAreHeardThen) {
    MemberCase c(kAlarm);
    c.hold();
    c.hear(Lost{"gone"});
    c.hear(Connected{});
    c.event("r2", {1, 3, {}, {5}});
    c.event("r2", {2, 3, {}, {6}});
    EXPECT_TRUE(c.all<EmitOnBus>().empty());
    c.question("i1");
    c.event("r2", {2, 3, {}, {6}});  // QoS 1 may come twice
    const auto heard = c.all<EmitOnBus>();
    ASSERT_EQ(heard.size(), 2u);
    EXPECT_EQ(heard[0].args, (std::vector<int16_t>{5}));
    EXPECT_EQ(heard[1].args, (std::vector<int16_t>{6}));
}

TEST(MemberEvents, ThoseThatAreTooManyOrTooOldBeforeTheNameIsOursAreNot) {
    MemberCase c(kAlarm);
    c.hear(Connected{});
    for (int64_t i = 0; i <= static_cast<int64_t>(kEarlyMax); ++i)
        c.event("r2", {i + 1, 3, {}, {}});
    EXPECT_EQ(c.member.left_out(), 1u);
    c.now = kEventAgeMax + 1us;
    c.question("i1");
    EXPECT_TRUE(c.all<EmitOnBus>().empty());
}

TEST(MemberEvents, ThoseOfACutLinkComeLaterInOrder) {
    MemberCase c(kAlarm);
    c.hold();
    c.hear(Lost{"gone"});
    c.member.emitted("alarm", {1}, 0s);
    c.member.emitted("alarm", {2}, 0s);
    c.take();
    EXPECT_TRUE(c.published<Event>().empty());
    c.now = 5s;
    c.hear(Connected{});
    c.question("i1");
    const auto sent = c.published<Event>();
    ASSERT_EQ(sent.size(), 2u);
    EXPECT_EQ(sent[0].args, (std::vector<int16_t>{1}));
    EXPECT_EQ(sent[1].args, (std::vector<int16_t>{2}));
}

TEST(MemberEvents, MoreArgumentsThanABusCarriesAreLeftOut) {
    MemberCase c(kAlarm);
    c.hold();
    c.member.emitted("alarm", std::vector<int16_t>(kWordsMax), 0s);
    c.member.emitted("alarm", std::vector<int16_t>(kWordsMax + 1), 0s);
    c.take();
    EXPECT_EQ(c.published<Event>().size(), 1u);
    EXPECT_EQ(c.member.left_out(), 1u);
}

// ---- state and variables ----

TEST(MemberState, ComesOnAChangeAtMostFiveTimesASecond) {
    MemberCase c;
    c.hold();
    c.member.show({.state = "running"}, 100ms);
    c.tick(100ms);
    EXPECT_TRUE(c.published<State>().empty());
    EXPECT_EQ(c.member.next_tick(), kStateEveryMin);
    c.tick(kStateEveryMin);
    ASSERT_EQ(c.published<State>().size(), 1u);
    EXPECT_EQ(c.published<State>()[0].state, "running");
    EXPECT_EQ(c.published<State>()[0].since, 100);
    EXPECT_EQ(c.published<State>()[0].clock, 200);
}

TEST(MemberState, ComesEveryTwoSecondsWithoutAChange) {
    MemberCase c;
    c.hold();
    c.tick(kStateEveryMax - 1us);
    EXPECT_TRUE(c.published<State>().empty());
    c.tick(kStateEveryMax);
    EXPECT_EQ(c.published<State>().size(), 1u);
}

TEST(MemberState, OnlyTheHolderShowsOne) {
    MemberCase c;
    c.tick(kStateEveryMax);
    EXPECT_TRUE(c.published<State>().empty());
}

TEST(MemberState, VariablesComeWhenTheyChangeAtMostFiveTimesASecond) {
    MemberCase c;
    c.hold();
    c.member.changed("drive", "speed", {1});
    c.tick(0s);
    c.member.changed("drive", "speed", {2});
    c.tick(kVariableEveryMin - 1us);
    c.member.changed("drive", "speed", {3});
    c.tick(kVariableEveryMin);
    c.member.changed("drive", "speed", {3});
    c.tick(1s);
    const auto told = c.published<Variable>();
    ASSERT_EQ(told.size(), 2u);
    EXPECT_EQ(told[0].values, (std::vector<int16_t>{1}));
    EXPECT_EQ(told[1].values, (std::vector<int16_t>{3}));
}

TEST(MemberState, AVariableThatSomebodyAsksForIsToldAgain) {
    MemberCase c;
    c.hold();
    c.member.tell_again("drive", "speed");  // not known yet
    c.member.changed("drive", "speed", {1});
    c.tick(0s);
    c.member.tell_again("drive", "speed");
    c.tick(1s);
    EXPECT_EQ(c.published<Variable>().size(), 2u);
}

// ---- commands ----

Command start(const std::string& id, int64_t deadline, int64_t epoch = 7) {
    return {.verb = "start", .id = id, .reply = "op", .epoch = epoch, .deadline = deadline};
}

TEST(MemberCommands, AreDoneOnceAndAnsweredAgain) {
    MemberCase c;
    c.hold();
    c.command(start("c1", 3000));
    ASSERT_EQ(c.all<Obey>().size(), 1u);
    c.command(start("c1", 3000));
    EXPECT_TRUE(c.published<Answer>().empty()) << "it is under way";
    c.member.answer(c.all<Obey>()[0].command, {.done = true});
    c.take();
    c.command(start("c1", 3000));
    EXPECT_EQ(c.all<Obey>().size(), 1u);
    const Answer done{.id = "c1", .done = true};
    EXPECT_EQ(c.published<Answer>(), (std::vector{done, done}));
    EXPECT_EQ(c.all<Post>()[0].topic, "vagus/1/lab/robot/r1/answer/op");
}

TEST(MemberCommands, LateOnesAreRefusedByTheRobotsOwnClock) {
    MemberCase c;
    c.hold();
    c.now = 5s;
    c.command(start("in time", 5000));
    c.command(start("late", 4999));
    c.command(start("no deadline", 5000 + kDeadlineAheadMax / 1ms + 1));
    c.command(start("another epoch", 6000, 6));
    Command without = start("without", 0);
    without.deadline.reset();
    c.command(without);
    ASSERT_EQ(c.all<Obey>().size(), 1u);
    EXPECT_EQ(c.all<Obey>()[0].command.id, "in time");
    const auto answers = c.published<Answer>();
    ASSERT_EQ(answers.size(), 4u);
    EXPECT_EQ(answers[0].what, "it came 1 ms too late, and was not done");
    for (const Answer& answer : answers) EXPECT_FALSE(answer.done) << answer.id;
}

TEST(MemberCommands, StopHasNoDeadline) {
    MemberCase c;
    c.hold();
    c.command({.verb = "stop", .id = "s1", .reply = "op"});
    EXPECT_EQ(c.all<Obey>().size(), 1u);
}

TEST(MemberCommands, OnlyStopGoesToMany) {
    MemberCase c(kAlarm);
    c.hold();
    const auto send = [&](const std::string& group, const std::string& verb, const char* id) {
        Command command = start(id, 1000);
        command.verb = verb;
        c.hear({.kind = Kind::Command, .group = group, .name = verb}, command);
    };
    send("", "start", "a");
    send("red", "start", "b");
    send("blue", "stop", "c");
    EXPECT_TRUE(c.all<Obey>().empty());
    send("red", "stop", "d");
    send("", "stop", "e");
    EXPECT_EQ(c.all<Obey>().size(), 2u);
}

TEST(MemberCommands, StopForAllIsObeyedByOneThatStaysOut) {
    MemberCase c;
    c.stay_out();
    c.hear({.kind = Kind::Command, .name = "stop"},
           Command{.verb = "stop", .id = "s", .reply = "op"});
    EXPECT_EQ(c.all<Obey>().size(), 1u);
    c.command(start("c", 1000));
    EXPECT_EQ(c.all<Obey>().size(), 1u);
}

TEST(MemberCommands, TheLastOnesAreRemembered) {
    MemberCase c;
    c.hold();
    const auto stop = [&](size_t number) {
        c.command({.verb = "stop", .id = std::to_string(number), .reply = "op"});
    };
    for (size_t i = 0; i < kCommandsRemembered; ++i) stop(i);
    stop(0);
    EXPECT_EQ(c.all<Obey>().size(), kCommandsRemembered);
    stop(kCommandsRemembered);
    stop(0);
    EXPECT_EQ(c.all<Obey>().size(), kCommandsRemembered + 2);
}

}  // namespace
}  // namespace vagus::fleet
