#include "serve/target/dropped_events.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

using debug::ProgramState;

// The vector of the specification's example (3.1): event 0 at word 5, init at word 24.
TEST(DroppedEvents, AProgramHandlesWhatItsTableOfEventsNames) {
    aesl::Program program;
    EXPECT_FALSE(handles(program, 0));
    program.bytecode = {5, 0, 5, 0xffff, 24, 7};
    EXPECT_TRUE(handles(program, 0));
    EXPECT_FALSE(handles(program, 5));  // an address is no event
    EXPECT_FALSE(handles(program, 7));  // behind the table
}

TEST(DroppedEvents, OnlyWhatComesWhileTheNodeStandsInsideAnEventIsCounted) {
    DroppedEvents dropped;
    dropped.came(2, true);
    EXPECT_FALSE(dropped.of(2));
    dropped.state(2, ProgramState::Paused);
    EXPECT_EQ(dropped.of(2), 0u);
    dropped.came(2, true);
    dropped.came(2, false);  // its script has no handler: nothing is lost
    dropped.came(3, true);
    EXPECT_EQ(dropped.of(2), 1u);
    dropped.state(2, ProgramState::Paused);  // a step to the next line
    dropped.came(2, true);
    EXPECT_EQ(dropped.of(2), 2u);
    dropped.state(2, ProgramState::Running);
    EXPECT_FALSE(dropped.of(2));
    dropped.state(2, ProgramState::Paused);
    EXPECT_EQ(dropped.of(2), 0u);
}

// Paused between two events, it takes the next one and pauses at its first line.
TEST(DroppedEvents, ANodeThatStandsBetweenTwoEventsDropsNone) {
    DroppedEvents dropped;
    dropped.state(2, ProgramState::Stopped);
    dropped.came(2, true);
    EXPECT_FALSE(dropped.of(2));
}

TEST(DroppedEvents, WhatAnUnknownScriptDropsIsNotKnown) {
    DroppedEvents dropped;
    dropped.state(2, ProgramState::Paused);
    dropped.came(2, true);
    dropped.came(2, std::nullopt);
    EXPECT_TRUE(dropped.is_paused(2));
    EXPECT_FALSE(dropped.of(2));
}

}  // namespace
}  // namespace vagus::serve
