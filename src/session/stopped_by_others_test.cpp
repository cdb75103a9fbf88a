#include "session/stopped_by_others.hpp"

#include <gtest/gtest.h>

namespace vagus::session {
namespace {

using namespace std::chrono_literals;
using State = debug::ProgramState;

using Nodes = std::vector<debug::NodeId>;

class Others : public testing::Test {
protected:
    void state(Time at, debug::NodeId node, State state) {
        others_.hear({at, node, debug::StateChanged{state, {}}});
    }
    void breakpoint(Time at, debug::NodeId node) {
        others_.hear({at, node, debug::StateChanged{State::Paused, {}, true}});
    }
    std::vector<debug::NodeId> due(Time at) { return others_.take_due(at); }
    StoppedByOthers others_{3s};
};

TEST_F(Others, ANodeIsDueWhenItWasStoppedForSoLong) {
    state(0s, 4, State::Running);
    state(1s, 4, State::Stopped);
    EXPECT_EQ(others_.next(), Time(4s));
    EXPECT_EQ(due(4s - 1us), Nodes{});
    EXPECT_EQ(due(4s), Nodes{4});
    EXPECT_EQ(due(5s), Nodes{});  // once
    EXPECT_EQ(others_.next(), Time::max());
}

TEST_F(Others, AnEventThatWaitsForItLetsItNotRun) {
    state(0s, 4, State::Running);
    state(1s, 4, State::Stopped);
    state(2s, 4, State::Paused);
    EXPECT_EQ(due(4s), Nodes{4});
}

TEST_F(Others, OneThatRunsAgainOrIsAwayIsNotWaitedFor) {
    for (const debug::NodeId node : Nodes{4, 5}) {
        state(0s, node, State::Running);
        state(1s, node, State::Stopped);
    }
    state(2s, 4, State::Running);
    others_.hear({2s, 5, debug::NodeDisconnected{}});
    EXPECT_EQ(others_.next(), Time::max());
    EXPECT_EQ(due(10s), Nodes{});
}

// As after a reset: paused in front of its first line.
TEST_F(Others, OneThatIsPausedInFrontOfAnEventCountsAsStopped) {
    state(0s, 4, State::Running);
    state(1s, 4, State::Paused);
    EXPECT_EQ(due(4s), Nodes{4});
}

TEST_F(Others, OneWithoutAProgramWasNotStoppedAndOneAtABreakpointNeither) {
    state(0s, 4, State::Stopped);
    state(0s, 5, State::Running);
    breakpoint(1s, 5);
    EXPECT_EQ(due(10s), Nodes{});
}

TEST_F(Others, OneThatSomebodyHoldsIsWaitedForAndCountsFromWhenItIsNotHeldAnyMore) {
    state(0s, 4, State::Running);
    state(1s, 4, State::Stopped);
    others_.hold({4}, 2s);
    EXPECT_EQ(others_.next(), Time::max());
    EXPECT_EQ(due(100s), Nodes{});
    others_.hold({}, 100s);
    EXPECT_EQ(others_.next(), Time(103s));
    EXPECT_EQ(due(103s), Nodes{4});
}

}  // namespace
}  // namespace vagus::session
