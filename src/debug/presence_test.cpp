#include "debug/presence.hpp"

#include "debug/scripted_bus.hpp"

namespace vagus::debug {
namespace {

// One ListNodes, and an answer of each of two nodes that both have the id 1.
void round_with_two(ScriptedBus& bus) {
    bus.network.list_nodes();
    bus.node_says(kPresent1);
    bus.node_says(kPresent1);
}

// The words of memory that node 1 was asked for since the last call.
std::vector<wire::GetVariables> asked_for(ScriptedBus& bus) {
    std::vector<wire::GetVariables> asked;
    for (const wire::Frame& frame : bus.network.take_frames()) {
        wire::GetVariables one;
        if (frame.type != static_cast<uint16_t>(wire::MessageType::GetVariables)) continue;
        EXPECT_EQ(wire::decode_message(frame, one), wire::Error::None);
        asked.push_back(one);
    }
    return asked;
}

void answer(ScriptedBus& bus, const wire::GetVariables& question) {
    wire::Variables reply{};
    reply.start = question.start;
    reply.values.count = question.length;
    bus.node_sends(1, reply);
}

TEST(SharedId, TwoAnswersToOneQuestionAreADoubtAndTwoToEachOfTwoProbesCertain) {
    ScriptedBus bus;
    bus.meet_robot(1);
    round_with_two(bus);
    EXPECT_TRUE(bus.network.doubts_an_id());
    bus.forget();
    bus.network.list_nodes();
    EXPECT_FALSE(bus.network.doubts_an_id());
    EXPECT_TRUE(bus.network.examines_ids());
    const auto asked = asked_for(bus);
    ASSERT_EQ(asked.size(), 2u);
    for (const auto& one : asked) {
        EXPECT_GE(one.length, 1);
        EXPECT_LE(one.start + one.length, 800);  // of the robot
        EXPECT_TRUE(bus.told<NodeIdShared>().empty());
        answer(bus, one);
        answer(bus, one);
    }
    EXPECT_FALSE(bus.network.examines_ids());
    ASSERT_EQ(bus.told<NodeIdShared>().size(), 1u);
    EXPECT_EQ(bus.told<NodeIdShared>()[0].other_name, "");
    EXPECT_TRUE(bus.network.node(1)->id_shared);
    round_with_two(bus);
    EXPECT_FALSE(bus.network.doubts_an_id()) << "told once";
}

// Three commands, one behind the other, asked a slow board: it answers all of them now.
TEST(SharedId, LateAnswersToEarlierHostsAreNoSecondNode) {
    ScriptedBus bus;
    bus.meet_robot(1);
    for (int round = 0; round < 3; round++) {
        bus.network.list_nodes();
        for (int late = 0; late < 4; late++) bus.node_says(kPresent1);
        const auto asked = asked_for(bus);
        for (const auto& one : asked) answer(bus, one);
        bus.pass(milliseconds(100));
    }
    EXPECT_TRUE(bus.told<NodeIdShared>().empty());
    EXPECT_FALSE(bus.network.node(1)->id_shared);
}

// Another host may ask for the same words as one of the probes.
TEST(SharedId, OneProbeThatIsAnsweredTwiceIsNoProof) {
    ScriptedBus bus;
    bus.meet_robot(1);
    round_with_two(bus);
    bus.forget();
    bus.network.list_nodes();
    const auto asked = asked_for(bus);
    ASSERT_EQ(asked.size(), 2u);
    answer(bus, asked[0]);
    answer(bus, asked[0]);
    answer(bus, asked[1]);
    EXPECT_TRUE(bus.told<NodeIdShared>().empty());
}

TEST(SharedId, EachHostProbesOtherWords) {
    const auto probes_at = [](Duration time) {
        Presences presences;
        return presences.settle(1, 800, Time(time));
    };
    const Probes early = probes_at(milliseconds(1000));
    const Probes late = probes_at(milliseconds(1500));
    EXPECT_NE(early[0], early[1]);
    EXPECT_NE(early, late);
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
