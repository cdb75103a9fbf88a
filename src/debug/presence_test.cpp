#include "debug/presence.hpp"

#include "debug/scripted_bus.hpp"

namespace vagus::debug {
namespace {

constexpr const char* kPresent1 = "02 00 01 00 0c 90 05 00";

// One ListNodes, and an answer of each of two nodes that both have the id 1.
void round_with_two(ScriptedBus& bus) {
    bus.network.list_nodes();
    bus.node_says(kPresent1);
    bus.node_says(kPresent1);
}

TEST(SharedId, TwoAnswersToOneQuestionAreADoubtAndInTwoRoundsCertain) {
    ScriptedBus bus;
    round_with_two(bus);
    EXPECT_TRUE(bus.network.doubts_an_id());
    EXPECT_TRUE(bus.told<NodeIdShared>().empty());
    round_with_two(bus);
    EXPECT_FALSE(bus.network.doubts_an_id());
    ASSERT_EQ(bus.told<NodeIdShared>().size(), 1u);
    EXPECT_EQ(bus.told<NodeIdShared>()[0].other_name, "");
    EXPECT_TRUE(bus.network.node(1)->id_shared);
    round_with_two(bus);
    EXPECT_EQ(bus.told<NodeIdShared>().size(), 1u) << "once";
}

TEST(SharedId, AnAnswerToAQuestionThatWeDidNotHearIsForgiven) {
    ScriptedBus bus;
    round_with_two(bus);
    for (int round = 0; round < 5; round++) {
        bus.network.list_nodes();
        bus.node_says(kPresent1);
    }
    EXPECT_FALSE(bus.network.doubts_an_id());
    EXPECT_TRUE(bus.told<NodeIdShared>().empty());
}

TEST(SharedId, QuestionsOfOtherHostsAllowFurtherAnswers) {
    ScriptedBus bus;
    for (int round = 0; round < 5; round++) {
        bus.network.list_nodes();
        bus.node_says("02 00 00 00 11 a0 05 00");  // ListNodes of another host
        bus.node_says(kPresent1);
        bus.node_says(kPresent1);
    }
    EXPECT_FALSE(bus.network.doubts_an_id());
    EXPECT_TRUE(bus.told<NodeIdShared>().empty());
}

// Their questions come before the first answer does, round after round.
TEST(SharedId, EightHostsMayAskAtOnce) {
    ScriptedBus bus;
    for (int round = 0; round < 5; round++) {
        bus.network.list_nodes();
        for (int host = 1; host < 8; host++) bus.node_says("02 00 00 00 11 a0 05 00");
        for (int answer = 0; answer < 8; answer++) bus.node_says(kPresent1);
        EXPECT_FALSE(bus.network.doubts_an_id()) << round;
    }
    EXPECT_TRUE(bus.told<NodeIdShared>().empty());
}

// Answers that were late or lost: at most eight are made up for, then the second node shows.
TEST(SharedId, LostAnswersHideTheOtherNodeForEightAnswersOnly) {
    ScriptedBus bus;
    bus.network.list_nodes();
    bus.node_says(kPresent1);
    for (int lost = 0; lost < 10; lost++) bus.network.list_nodes();
    for (int answer = 0; answer < 8; answer++) bus.node_says(kPresent1);
    EXPECT_FALSE(bus.network.doubts_an_id());
    bus.node_says(kPresent1);
    EXPECT_TRUE(bus.network.doubts_an_id());
}

TEST(SharedId, TwoNamesWithinASecondAreCertainAtOnce) {
    ScriptedBus bus;
    bus.node_says(kPresent1);
    bus.node_says(
        "18 00 01 00 00 90 09 74 68 79 6d 69 6f 2d 49 49 05 00 fe 05 20 00 4a 02 02 00 00 00 00 "
        "00");
    EXPECT_TRUE(bus.told<NodeIdShared>().empty());
    bus.describe_robot(1);
    ASSERT_EQ(bus.told<NodeIdShared>().size(), 1u);
    EXPECT_EQ(bus.told<NodeIdShared>()[0].other_name, "thymio-II");
    EXPECT_EQ(bus.network.node(1)->other_name, "thymio-II");
}

TEST(SharedId, ANodeThatComesBackUnderAnotherNameIsOneNode) {
    ScriptedBus bus;
    bus.meet_robot(1);
    bus.pass(kNamesWithin);
    bus.node_says(
        "18 00 01 00 00 90 09 74 68 79 6d 69 6f 2d 49 49 05 00 fe 05 20 00 4a 02 02 00 00 00 00 "
        "00");
    EXPECT_TRUE(bus.told<NodeIdShared>().empty());
}

}  // namespace
}  // namespace vagus::debug
