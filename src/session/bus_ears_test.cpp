#include "session/bus_ears.hpp"

#include <gtest/gtest.h>

namespace vagus::session {
namespace {

debug::Event event(debug::NodeId node, debug::Happening what) {
    return {Time{}, node, std::move(what)};
}

TEST(BusEars, APlanHearsEventsThatHaveNames) {
    toolbox::BusNodes nodes;
    BusEars ears(nodes);
    const auto heard = ears.hear(event(3, debug::UserEvent{7, "touched", {450}}));
    ASSERT_TRUE(heard.has_value());
    EXPECT_EQ(heard->name, "touched");
    EXPECT_EQ(heard->arguments, std::vector<int16_t>{450});
    EXPECT_FALSE(ears.hear(event(3, debug::UserEvent{8, "", {}})).has_value());
    EXPECT_FALSE(ears.hear(event(3, debug::NodeAppeared{5})).has_value());
}

TEST(BusEars, ANodeIsThereFromItsDescriptionUntilItLeaves) {
    toolbox::BusNodes nodes;
    BusEars ears(nodes);
    EXPECT_FALSE(ears.hear(event(1, debug::NodeDescribed{"drive"})).has_value());
    EXPECT_TRUE(nodes.has("drive"));
    const auto left = ears.hear(event(1, debug::NodeDisconnected{}));
    ASSERT_TRUE(left.has_value());
    EXPECT_EQ(left->name, toolbox::node_left("drive"));
    EXPECT_FALSE(nodes.has("drive"));
    EXPECT_FALSE(ears.hear(event(1, debug::NodeDisconnected{true})).has_value());  // once
    EXPECT_FALSE(ears.hear(event(1, debug::NodeReconnected{})).has_value());
    EXPECT_TRUE(nodes.has("drive"));
}

// A program that was stopped cannot answer the plan any more, until it runs again.
TEST(BusEars, APlanHearsThatAProgramWasStoppedAndThatItRunsAgain) {
    using State = debug::ProgramState;
    toolbox::BusNodes nodes;
    BusEars ears(nodes);
    const auto state = [&](State now) { return ears.hear(event(1, debug::StateChanged{now, {}})); };
    EXPECT_FALSE(state(State::Stopped).has_value());  // of a node without a name
    (void)ears.hear(event(1, debug::NodeDescribed{"drive"}));
    EXPECT_FALSE(state(State::Running).has_value());
    const auto stopped = state(State::Stopped);
    ASSERT_TRUE(stopped.has_value());
    EXPECT_EQ(stopped->name, toolbox::node_stopped("drive"));
    EXPECT_FALSE(state(State::Stopped).has_value());
    EXPECT_FALSE(state(State::Paused).has_value());  // an event waits for it
    const auto runs = state(State::Running);
    ASSERT_TRUE(runs.has_value());
    EXPECT_EQ(runs->name, toolbox::node_runs("drive"));
}

// After a reset it is paused in front of its first line; at a breakpoint somebody looks for a
// mistake.
TEST(BusEars, AResetStopsAProgramAndABreakpointDoesNot) {
    using State = debug::ProgramState;
    toolbox::BusNodes nodes;
    BusEars ears(nodes);
    (void)ears.hear(event(1, debug::NodeDescribed{"drive"}));
    (void)ears.hear(event(1, debug::StateChanged{State::Running, {}}));
    EXPECT_FALSE(ears.hear(event(1, debug::StateChanged{State::Paused, {}, true})).has_value());
    const auto reset = ears.hear(event(1, debug::StateChanged{State::Paused, {}, false}));
    ASSERT_TRUE(reset.has_value());
    EXPECT_EQ(reset->name, toolbox::node_stopped("drive"));
}

TEST(BusEars, APlanDoesNotHearThatANodeWasStoppedThatSomebodyHolds) {
    using State = debug::ProgramState;
    toolbox::BusNodes nodes;
    BusEars ears(nodes);
    const auto state = [&](State now) { return ears.hear(event(1, debug::StateChanged{now, {}})); };
    (void)ears.hear(event(1, debug::NodeDescribed{"drive"}));
    (void)state(State::Running);
    EXPECT_TRUE(state(State::Stopped).has_value());
    // It is told later who did that.
    const auto held = ears.hold({1});
    ASSERT_EQ(held.size(), 1u);
    EXPECT_EQ(held[0].name, toolbox::node_runs("drive"));
    EXPECT_FALSE(nodes.is_stopped("drive"));
    EXPECT_FALSE(state(State::Running).has_value());
    EXPECT_FALSE(state(State::Stopped).has_value());
    EXPECT_TRUE(ears.hold({1, 2}).empty());
    const auto left = ears.hold({});
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].name, toolbox::node_stopped("drive"));
    EXPECT_TRUE(nodes.is_stopped("drive"));
}

// The state of a node is asked for when work with it begins: older reports are not repeated.
TEST(BusEars, WhoseProgramWasStoppedCanBeAsked) {
    using State = debug::ProgramState;
    toolbox::BusNodes nodes;
    {
        BusEars ears(nodes);
        const auto state = [&](State now) {
            (void)ears.hear(event(1, debug::StateChanged{now, {}}));
        };
        (void)ears.hear(event(1, debug::NodeDescribed{"drive"}));
        state(State::Stopped);  // it has no program yet
        EXPECT_FALSE(nodes.is_stopped("drive"));
        state(State::Running);
        state(State::Stopped);
        EXPECT_TRUE(nodes.is_stopped("drive"));
        (void)ears.hear(event(1, debug::NodeDescribed{"range"}));
        EXPECT_FALSE(nodes.is_stopped("drive"));
        EXPECT_TRUE(nodes.is_stopped("range"));
        state(State::Running);
        EXPECT_FALSE(nodes.is_stopped("range"));
        state(State::Stopped);
    }
    EXPECT_FALSE(nodes.is_stopped("range"));
}

// Two drives: one of them can go.
TEST(BusEars, OnlyTheLastOfANameLeaves) {
    toolbox::BusNodes nodes;
    BusEars ears(nodes);
    (void)ears.hear(event(1, debug::NodeDescribed{"drive"}));
    (void)ears.hear(event(9, debug::NodeDescribed{"drive"}));
    EXPECT_FALSE(ears.hear(event(1, debug::NodeDisconnected{})).has_value());
    EXPECT_TRUE(nodes.has("drive"));
    EXPECT_TRUE(ears.hear(event(9, debug::NodeDisconnected{})).has_value());
}

TEST(BusEars, ANodeThatComesBackUnderAnotherNameHasLeftUnderTheOld) {
    toolbox::BusNodes nodes;
    BusEars ears(nodes);
    (void)ears.hear(event(1, debug::NodeDescribed{"drive"}));
    const auto left = ears.hear(event(1, debug::NodeDescribed{"range"}));
    ASSERT_TRUE(left.has_value());
    EXPECT_EQ(left->name, toolbox::node_left("drive"));
    EXPECT_TRUE(nodes.has("range"));
    EXPECT_FALSE(nodes.has("drive"));
}

// A plan for the robot with the nodes 5 and 6, on a bus that others share.
TEST(BusEars, OfSeveralRobotsOnlyTheNodesOfOneAreHeard) {
    toolbox::BusNodes nodes;
    BusEars ears(nodes, {5, 6});
    (void)ears.hear(event(1, debug::NodeDescribed{"range"}));
    (void)ears.hear(event(5, debug::NodeDescribed{"drive"}));
    EXPECT_FALSE(nodes.has("range"));
    EXPECT_TRUE(nodes.has("drive"));
    const debug::UserEvent touched{7, "touched", {450}};
    EXPECT_FALSE(ears.hear(event(1, touched)).has_value());
    EXPECT_TRUE(ears.hear(event(6, touched)).has_value());
    EXPECT_TRUE(ears.hear(event(0, touched)).has_value());  // a host, as a person may be
}

TEST(BusEars, ItsNodesGoWithIt) {
    toolbox::BusNodes nodes;
    {
        BusEars ears(nodes);
        (void)ears.hear(event(1, debug::NodeDescribed{"drive"}));
    }
    EXPECT_FALSE(nodes.has("drive"));
}

}  // namespace
}  // namespace vagus::session
