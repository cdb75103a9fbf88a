// Who has the name of a robot.
#include "fleet/test_member.hpp"

namespace vagus::fleet {
namespace {

using Texts = std::vector<std::string>;

TEST(MemberName, AFreeNameIsTakenWhenItsOwnQuestionComesBack) {
    MemberCase c;
    c.hear(Connected{});
    EXPECT_EQ(c.published<Ask>().size(), 1u);
    EXPECT_EQ(c.connections(), Texts{});
    c.question("i1");
    EXPECT_EQ(c.member.standing(), Member::Standing::Holding);
    EXPECT_EQ(c.connections(), Texts{"online"});
    EXPECT_EQ(c.published<Description>().size(), 1u);
    EXPECT_EQ(c.published<State>().size(), 1u);
}

TEST(MemberName, OneThatAnswersKeepsIt) {
    MemberCase c;
    c.hear(Connected{});
    c.connection("online", "i2");
    c.question("i1");
    EXPECT_EQ(c.member.standing(), Member::Standing::Asking);
    c.name_answer("i2");
    EXPECT_EQ(c.member.standing(), Member::Standing::Out);
    c.tick(kNameAnswerWithin);
    EXPECT_EQ(c.member.standing(), Member::Standing::Out);
    EXPECT_EQ(c.connections(), Texts{});
    EXPECT_EQ(c.all<Say>().front().kind, "error");
}

TEST(MemberName, OneThatDoesNotAnswerLosesIt) {
    MemberCase c;
    c.hear(Connected{});
    c.connection("online", "i2");
    c.question("i1");
    EXPECT_EQ(c.member.next_tick(), kNameAnswerWithin);
    c.tick(kNameAnswerWithin - 1us);
    EXPECT_EQ(c.member.standing(), Member::Standing::Asking);
    c.tick(kNameAnswerWithin);
    EXPECT_EQ(c.member.standing(), Member::Standing::Holding);
}

TEST(MemberName, OneThatIsLostOrOfflineLeavesItFree) {
    for (const char* const state : {"lost", "offline"}) {
        MemberCase c;
        c.hear(Connected{});
        c.connection(state, "i2");
        c.question("i1");
        EXPECT_EQ(c.member.standing(), Member::Standing::Holding) << state;
    }
}

TEST(MemberName, ItsHolderAnswersOthersAndNotItself) {
    MemberCase c;
    c.hold();
    c.question("i1");
    c.tick(1s);
    EXPECT_TRUE(c.published<Answer>().empty());
    c.question("i2");
    c.tick(1s);
    EXPECT_EQ(c.published<Answer>(),
              (std::vector{Answer{.id = "i2", .done = true, .instance = "i1"}}));
}

TEST(MemberName, AnothersWillIsOverwritten) {
    MemberCase c;
    c.hold();
    c.connection("lost", "i2");
    EXPECT_EQ(c.connections(), Texts{"online"});
}

TEST(MemberName, AWillOfItsOwnThatComesLateIsOverwritten) {
    MemberCase c;
    c.hold();
    c.connection("lost", "i1");
    EXPECT_EQ(c.connections(), Texts{"online"});
}

TEST(MemberName, OfTwoThatClaimAtOnceTheBrokersLastWins) {
    MemberCase first, last({}, "i2");
    for (MemberCase* c : {&first, &last}) {
        c->hear(Connected{});
        c->question(c == &first ? "i1" : "i2");
        c->connection("online", "i1");
        c->connection("online", "i2");
    }
    EXPECT_EQ(first.member.standing(), Member::Standing::Out);
    EXPECT_EQ(last.member.standing(), Member::Standing::Holding);
}

TEST(MemberName, WhatWasClaimedBeforeAnOnlineThatIsOnItsWayDoesNotCount) {
    MemberCase holder, newcomer({}, "i2");
    holder.hold();
    newcomer.hear(Connected{});
    for (MemberCase* c : {&holder, &newcomer}) c->connection("lost", "i3");
    newcomer.question("i2");
    for (MemberCase* c : {&holder, &newcomer}) {
        c->connection("online", "i2");
        c->connection("online", "i1");
    }
    EXPECT_EQ(holder.member.standing(), Member::Standing::Holding);
    EXPECT_EQ(newcomer.member.standing(), Member::Standing::Out);
    holder.connection("online", "i4");
    EXPECT_EQ(holder.member.standing(), Member::Standing::Out);
}

// A hundred that claim it at once do not answer each other.
TEST(MemberName, WhoAsksIsAnsweredWhenTheNameIsCertain) {
    MemberCase c;
    c.hear(Connected{});
    c.question("i1");
    c.question("i2");
    c.tick(1s);
    EXPECT_TRUE(c.published<Answer>().empty());
    c.connection("online", "i1");
    EXPECT_EQ(c.member.next_tick(), 1s);
    c.tick(1s);
    EXPECT_EQ(c.published<Answer>().size(), 1u);
}

TEST(MemberName, ItsHolderSaysAsLongAsAnotherWantsIt) {
    MemberCase c;
    c.hold();
    c.member.show({.problems = {"a wheel"}}, c.now);
    for (const Time asked : {Time(1s), Time(11s)}) {
        c.now = asked;
        c.question("i2");
        c.tick(asked);
    }
    ASSERT_EQ(c.all<Say>().size(), 1u);
    EXPECT_EQ(c.all<Say>()[0].text,
              "fleet: another program wants the name \"r1\", too, and was told to stay out. Give "
              "each robot a name of its own (--robot, or \"name\" in its world)");
    c.tick(35s);
    EXPECT_EQ(c.published<State>().back().problems,
              (Texts{"a wheel", "two programs want this name; the other one stays out"}));
    c.tick(11s + kNameWantedFor);
    EXPECT_EQ(c.published<State>().back().problems, Texts{"a wheel"});
}

TEST(MemberName, WhoStaysOutAsksAgainAndSaysNoMore) {
    MemberCase c;
    c.hear(Connected{});
    c.connection("online", "i2");
    c.question("i1");
    c.name_answer("i2");
    c.actions.clear();
    EXPECT_EQ(c.member.next_tick(), kBrokerLostAfter);
    c.tick(kBrokerLostAfter);
    EXPECT_EQ(c.member.next_tick(), kNameAskAgain);
    c.tick(kNameAskAgain);
    EXPECT_EQ(c.published<Ask>().size(), 1u);
    c.question("i1");
    c.name_answer("i2");
    c.tick(kNameAskAgain + kNameAnswerWithin);
    EXPECT_EQ(c.member.standing(), Member::Standing::Out);
    EXPECT_TRUE(c.all<Say>().empty());
}

TEST(MemberName, ItIsAskedForAgainWhenItsHolderGoes) {
    MemberCase c;
    c.stay_out();
    c.connection("lost", "i2");
    EXPECT_EQ(c.member.standing(), Member::Standing::Asking);
    c.question("i1");
    EXPECT_EQ(c.member.standing(), Member::Standing::Holding);
}

TEST(MemberName, ItIsNotAskedForAgainWhenAnotherOneThatStayedOutGoes) {
    MemberCase c;
    c.stay_out();
    c.connection("lost", "i3");
    EXPECT_EQ(c.member.standing(), Member::Standing::Out);
    c.connection("online", "i2");
    c.connection("lost", "i2");
    EXPECT_EQ(c.member.standing(), Member::Standing::Asking);
}

TEST(MemberName, ABrokerThatHidesOurOwnMessagesIsNamed) {
    MemberCase c;
    c.hear(Connected{});
    c.tick(kNameAnswerWithin);
    EXPECT_EQ(c.member.standing(), Member::Standing::Asking);
    EXPECT_NE(c.all<Say>().front().text.find("access list"), std::string::npos);
}

TEST(MemberName, OfflineIsSaidByItsHolderAlone) {
    MemberCase c;
    c.member.leave();
    c.take();
    EXPECT_EQ(c.connections(), Texts{});
    MemberCase holder;
    holder.hold();
    holder.member.leave();
    holder.take();
    EXPECT_EQ(holder.connections(), Texts{"offline"});
}

}  // namespace
}  // namespace vagus::fleet
