#include "debug/roll_call.hpp"

#include "debug/scripted_bus.hpp"

namespace vagus::debug {
namespace {

class RollCalls : public testing::Test {
protected:
    void begin(RollCallOptions options) {
        options_ = std::move(options);
        call_.emplace(bus_.network, bus_.now, options_);
        (void)over();
    }
    // Lets that much time pass, in the steps that the call asks for. True: it is over.
    bool over(Duration within = {}) {
        const Time end = bus_.now + within;
        for (;;) {
            hear();
            if (call_->over(bus_.network, bus_.now)) return true;
            if (bus_.now >= end) return false;
            bus_.pass(std::min(end, std::max(call_->next(), bus_.now + milliseconds(1))) -
                      bus_.now);
        }
    }
    void answers(NodeId id) {
        wire::NodePresent present{};
        present.version = 5;
        bus_.node_sends(id, present);
        bus_.describe_robot(id);
        bus_.state(id, 0, 0);
        hear();
    }
    void hear() {
        for (const Event& event : bus_.network.take_events()) bus_.events.push_back(event);
        for (const Event& event : std::exchange(bus_.events, {})) call_->hear(event);
    }
    bool asked_directly(NodeId id) {
        for (const wire::Frame& frame : bus_.network.take_frames()) {
            const bool about =
                frame.type == static_cast<uint16_t>(wire::MessageType::GetNodeDescription);
            if (about && frame.first_word() == id) return true;
        }
        return false;
    }

    ScriptedBus bus_;
    RollCallOptions options_;
    std::optional<RollCall> call_;
};

TEST_F(RollCalls, EndsThreeTenthsOfASecondAfterFastAnswers) {
    begin({});
    bus_.pass(milliseconds(5));
    answers(1);
    answers(2);
    EXPECT_FALSE(over(milliseconds(299)));
    EXPECT_TRUE(over(milliseconds(1)));
}

TEST_F(RollCalls, WaitsAsLongAgainAsAnswersTookSoFar) {
    begin({});
    bus_.pass(milliseconds(900));
    answers(1);
    EXPECT_FALSE(over(milliseconds(850)));
    answers(2);
    EXPECT_FALSE(over(milliseconds(1700)));
    EXPECT_TRUE(over(milliseconds(50)));
}

TEST_F(RollCalls, TheFirstAnswerHasTwoSeconds) {
    begin({});
    EXPECT_FALSE(over(milliseconds(1999)));
    EXPECT_TRUE(over(milliseconds(1)));
}

// "net … save 3": four boards have answered, the fifth is slow.
TEST_F(RollCalls, ANodeThatIsAskedForByNumberIsAskedItselfAndWaitedFor) {
    begin({.wanted = {3}, .only_wanted = true});
    bus_.pass(milliseconds(5));
    for (const NodeId id : std::vector<NodeId>{1, 2, 4, 5}) answers(id);
    EXPECT_FALSE(over(kListEvery));
    EXPECT_TRUE(asked_directly(3));
    EXPECT_FALSE(over(milliseconds(3000)));
    answers(3);
    EXPECT_TRUE(over());
}

// "net … save 3" on a busy machine: the parts of its description come steadily, and slowly.
TEST_F(RollCalls, AWantedNodeThatDescribesItselfSlowlyIsWaitedFor) {
    begin({.wanted = {3}, .only_wanted = true});
    wire::NodePresent present{};
    present.version = 5;
    bus_.node_sends(3, present);
    wire::Description header{};
    header.name = {"robot", 5};
    header.protocol_version = 5;
    header.bytecode_size = 100;
    header.stack_size = 32;
    header.variables_size = 100;
    header.variable_count = 2;
    bus_.node_sends(3, header);
    bus_.variable(3, "id", 1);
    EXPECT_FALSE(over(milliseconds(2500)));
    bus_.variable(3, "source", 1);  // the last
    hear();
    EXPECT_FALSE(over(milliseconds(4500)));  // its state is still to come
    bus_.state(3, 0, 0);
    EXPECT_TRUE(over());
}

TEST_F(RollCalls, EachPartOfADescriptionGivesTheRestItsTime) {
    begin({});
    wire::NodePresent present{};
    present.version = 5;
    bus_.node_sends(3, present);
    wire::Description header{};
    header.name = {"robot", 5};
    header.protocol_version = 5;
    header.bytecode_size = 100;
    header.stack_size = 32;
    header.variables_size = 100;
    header.variable_count = 4;
    bus_.node_sends(3, header);
    for (const char* name : {"a", "b", "c"}) {
        EXPECT_FALSE(over(kNodesWithin - milliseconds(1)));
        bus_.variable(3, name, 1);
    }
    EXPECT_FALSE(over(kNodesWithin - milliseconds(1)));
    EXPECT_TRUE(over(milliseconds(1)));
}

TEST_F(RollCalls, OneThatNeverAnswersIsWaitedForFiveSecondsAfterTheLastAnswer) {
    begin({.wanted = {3}, .only_wanted = true});
    answers(1);
    EXPECT_FALSE(over(kWantedWithin - milliseconds(1)));
    EXPECT_TRUE(over(milliseconds(1)));
}

TEST_F(RollCalls, IsOverAsSoonAsThoseAreThereThatAreWanted) {
    begin({.wanted = {3}, .only_wanted = true});
    answers(3);
    EXPECT_TRUE(over());
    begin({.wanted = {3}, .only_wanted = false});
    EXPECT_FALSE(over());
}

TEST_F(RollCalls, ANodeThatSaysItIsThereIsWaitedForUntilItSaysWhatItIs) {
    begin({});
    wire::NodePresent present{};
    present.version = 5;
    bus_.node_sends(1, present);
    EXPECT_FALSE(over(kNodesWithin - milliseconds(1)));
    bus_.describe_robot(1);
    bus_.state(1, 0, 0);
    EXPECT_FALSE(over(milliseconds(299)));
    EXPECT_TRUE(over(milliseconds(10)));
}

// A doubt is settled within the call, and its answers are waited for.
TEST_F(RollCalls, WhetherTwoNodesShareAnIdIsAskedBeforeItEnds) {
    begin({});
    answers(1);
    wire::NodePresent present{};
    present.version = 5;
    bus_.node_sends(1, present);
    bus_.node_sends(1, present);
    EXPECT_FALSE(over(milliseconds(600)));
    EXPECT_TRUE(bus_.network.examines_ids());
    EXPECT_TRUE(over(kNodesWithin)) << "the node may never answer";
}

}  // namespace
}  // namespace vagus::debug
