#include "cli/screen/pace.hpp"

#include <gtest/gtest.h>

namespace vagus::cli {
namespace {

using namespace std::chrono_literals;

TEST(Pace, GoesUpAndDownALadderThatEndsAtAsFastAsItGoes) {
    Pace pace;
    EXPECT_EQ(pace.text(), "x1");
    EXPECT_TRUE(pace.act(Key::Faster));
    EXPECT_EQ(pace.text(), "x2");
    for (int i = 0; i < 5; i++) pace.act(Key::Faster);
    EXPECT_EQ(pace.text(), "max");
    EXPECT_TRUE(pace.hurries());
    pace.act(Key::Faster);
    EXPECT_EQ(pace.text(), "max");
    pace.act(Key::Slower);
    EXPECT_EQ(pace.text(), "x50");
    for (int i = 0; i < 9; i++) pace.act(Key::Slower);
    EXPECT_EQ(pace.text(), "x0.1");
    EXPECT_FALSE(pace.act(Key::Tap));
}

TEST(Pace, ASpeedBetweenTwoStepsGoesToTheNext) {
    Pace pace(3);
    EXPECT_EQ(pace.text(), "x3");
    pace.act(Key::Faster);
    EXPECT_EQ(pace.text(), "x5");
    Pace other(3);
    other.act(Key::Slower);
    EXPECT_EQ(other.text(), "x2");
}

TEST(Pace, OwesWhatHasNotPassedYet) {
    Pace pace(2);
    EXPECT_EQ(pace.due(10ms), 20ms);
    pace.pay(15ms);
    EXPECT_EQ(pace.due(1ms), 7ms);
    pace.act(Key::Pause);
    EXPECT_TRUE(pace.paused());
    EXPECT_EQ(pace.due(1s), 0ms);
    // Two steps of 200 ms at most, however long the machine slept.
    pace.act(Key::Pause);
    EXPECT_EQ(pace.due(10s), 400ms);
}

TEST(Pace, AStepEndsInRealTimeUnlessItIsLate) {
    EXPECT_EQ(Pace(2).end_of(1s, 100ms, 1s), 1050ms);
    EXPECT_EQ(Pace(2).end_of(1s, 100ms, 1250ms), 1050ms);  // 200 ms are made up for
    EXPECT_EQ(Pace(2).end_of(1s, 100ms, 1251ms), 1251ms);
    EXPECT_EQ(Pace(0).end_of(1s, 100ms, 1s), 1s);
}

}  // namespace
}  // namespace vagus::cli
