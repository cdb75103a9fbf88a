#include "session/stopping.hpp"

#include <gtest/gtest.h>

#include "debug/scripted_bus.hpp"

namespace vagus::session {
namespace {

using namespace std::chrono_literals;
using StopState = StopNode::State;
using Types = std::vector<wire::MessageType>;

constexpr uint16_t kSourceAt = 1;  // of the variable, in the description of the scripted robot
constexpr debug::NodeId kBoth[] = {2, 3};
constexpr uint16_t kStoppedFlags = wire::kFlagStep;

// Two nodes named "robot", 2 and 3. What drives them is `source`, and `id` tells their speed.
class Stoppings : public testing::Test {
protected:
    void SetUp() override {
        bus_.meet_robot(2);
        bus_.meet_robot(3);
    }

    void begin(Stopping::How how) {
        stopping_.begin(bus_.network, safe_, how, bus_.now);
        bus_.forget();
    }
    // What was sent to the node since, but for questions who is there.
    Types sent(debug::NodeId id) {
        Types types;
        for (const wire::Frame& frame : bus_.network.take_frames()) {
            if (wire::is_command(frame.type) && frame.first_word() == id) {
                types.push_back(static_cast<wire::MessageType>(frame.type));
            }
        }
        return types;
    }
    void says_stopped(debug::NodeId id) {
        bus_.state(id, 0, kStoppedFlags);
        pass(0ms);
    }
    void says(debug::NodeId id, uint16_t address, int16_t value) {
        wire::Variables reply{};
        reply.start = address;
        reply.values.count = 1;
        reply.values.values[0] = value;
        bus_.node_sends(id, reply);
        pass(0ms);
    }
    void pass(Duration time) {
        bus_.now += time;
        bus_.network.tick(bus_.now);
        for (const debug::Event& event : bus_.network.take_events()) bus_.events.push_back(event);
        for (const debug::Event& event : std::exchange(bus_.events, {})) stopping_.hear(event);
        stopping_.tick(bus_.now);
    }
    StopState state_of(debug::NodeId id) const {
        for (const StopNode& node : stopping_.report()) {
            if (node.node == id) return node.state;
        }
        return StopState::Gone;
    }

    debug::ScriptedBus bus_;
    const SafeStop safe_ = {{"robot", {{{"source", {0}}}, {"id"}}}};
    Stopping stopping_;
};

TEST_F(Stoppings, StopsAllThenWritesThenReadsWhatAnsweredStop) {
    stopping_.begin(bus_.network, safe_, Stopping::How::Stop, bus_.now);
    Types all;
    for (const wire::Frame& frame : bus_.network.take_frames()) {
        if (wire::is_command(frame.type)) {
            all.push_back(static_cast<wire::MessageType>(frame.type));
        }
    }
    EXPECT_EQ(all, (Types{wire::MessageType::Stop, wire::MessageType::Stop,
                          wire::MessageType::SetVariables, wire::MessageType::SetVariables}));
    says_stopped(2);
    EXPECT_EQ(sent(2), (Types{wire::MessageType::GetVariables, wire::MessageType::GetVariables}));
    EXPECT_EQ(state_of(2), StopState::Silent);  // an answered Stop is not yet "stopped"
    says(2, kSourceAt, 0);
    says(2, 0, 0);
    EXPECT_EQ(state_of(2), StopState::Stopped);
    EXPECT_FALSE(stopping_.settled());
    says_stopped(3);
    says(3, kSourceAt, 0);
    says(3, 0, 0);
    EXPECT_TRUE(stopping_.settled());
    EXPECT_EQ(describe(stopping_.report()), "at rest: robot (2), robot (3)");
}

TEST_F(Stoppings, WhatStillMovesIsWrittenAndReadAgain) {
    begin(Stopping::How::Stop);
    says_stopped(2);
    says(2, kSourceAt, 200);  // somebody wrote over it
    says(2, 0, 31);
    EXPECT_EQ(state_of(2), StopState::Moving);
    EXPECT_EQ(describe(stopping_.report()), "still moving: robot (2); did not answer: robot (3)");
    (void)sent(2);
    pass(kMovesReadEvery);
    EXPECT_EQ(sent(2), (Types{wire::MessageType::GetVariables, wire::MessageType::GetVariables}));
    says(2, kSourceAt, 0);
    says(2, 0, 0);
    EXPECT_EQ(state_of(2), StopState::Stopped);
}

TEST_F(Stoppings, WhoDoesNotAnswerIsAskedAgain) {
    begin(Stopping::How::Stop);
    pass(kStopAgain - 1ms);
    const auto of_this_kind = [](const Types& types, wire::MessageType kind) {
        return std::count(types.begin(), types.end(), kind);
    };
    EXPECT_EQ(of_this_kind(sent(3), wire::MessageType::Stop), 0);
    pass(1ms);
    const Types again = sent(3);
    EXPECT_GE(of_this_kind(again, wire::MessageType::Stop), 1);
    EXPECT_EQ(of_this_kind(again, wire::MessageType::SetVariables), 1);
    EXPECT_EQ(describe(stopping_.report()), "did not answer: robot (2), robot (3)");
}

TEST_F(Stoppings, RestLeavesScriptsAlone) {
    stopping_.begin(bus_.network, safe_, Stopping::How::Rest, bus_.now);
    EXPECT_EQ(sent(2), (Types{wire::MessageType::SetVariables, wire::MessageType::GetVariables,
                              wire::MessageType::GetVariables}));
    for (int reading = 0; reading < 2; ++reading) {
        EXPECT_FALSE(stopping_.settled());
        for (const debug::NodeId id : kBoth) {
            says(id, kSourceAt, 0);
            says(id, 0, 0);
        }
        if (reading == 0) pass(kRestHolds);
    }
    EXPECT_TRUE(stopping_.settled());
}

// What it was told before is still in its hands: the handler writes over what was written.
TEST_F(Stoppings, RestIsNotBelievedWhenAScriptMayStillWrite) {
    stopping_.begin(bus_.network, safe_, Stopping::How::Rest, bus_.now);
    says(2, kSourceAt, 0);
    says(2, 0, 0);
    EXPECT_NE(state_of(2), StopState::Stopped);
    (void)sent(2);
    pass(kRestHolds);
    EXPECT_EQ(sent(2), (Types{wire::MessageType::GetVariables, wire::MessageType::GetVariables}));
    says(2, kSourceAt, 200);
    says(2, 0, 0);
    EXPECT_EQ(state_of(2), StopState::Moving);
    EXPECT_EQ(sent(2), Types{wire::MessageType::SetVariables});
    for (const Duration later : {kMovesReadEvery, kRestHolds}) {
        EXPECT_NE(state_of(2), StopState::Stopped);
        pass(later);
        says(2, kSourceAt, 0);
        says(2, 0, 0);
    }
    EXPECT_EQ(state_of(2), StopState::Stopped);
}

TEST_F(Stoppings, LookOnlyReads) {
    stopping_.begin(bus_.network, safe_, Stopping::How::Look, bus_.now);
    EXPECT_EQ(sent(3), (Types{wire::MessageType::GetVariables, wire::MessageType::GetVariables}));
    for (const debug::NodeId id : kBoth) {
        says(id, kSourceAt, 100);
        says(id, 0, 0);
    }
    EXPECT_TRUE(stopping_.settled());
    EXPECT_EQ(state_of(3), StopState::Moving);
    EXPECT_TRUE(sent(3).empty());
}

TEST_F(Stoppings, ANodeWithoutADefinitionIsStoppedWhenItAnswersStop) {
    const SafeStop none;
    stopping_.begin(bus_.network, none, Stopping::How::Stop, bus_.now);
    says_stopped(2);
    EXPECT_EQ(state_of(2), StopState::Stopped);
    stopping_.begin(bus_.network, none, Stopping::How::Rest, bus_.now);
    EXPECT_TRUE(stopping_.report().empty());
    EXPECT_EQ(describe(stopping_.report()), "");
}

TEST_F(Stoppings, ANodeThatIsAwayIsToldWhenItIsBack) {
    begin(Stopping::How::Stop);
    bus_.network.link_lost();
    pass(0ms);
    EXPECT_EQ(state_of(2), StopState::Gone);
    (void)sent(2);
    wire::NodePresent present{};
    present.version = 5;
    bus_.node_sends(2, present);
    pass(0ms);
    const Types types = sent(2);
    EXPECT_NE(std::find(types.begin(), types.end(), wire::MessageType::Stop), types.end());
}

}  // namespace
}  // namespace vagus::session
