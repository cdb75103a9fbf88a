#include "cli/screen/degrees.hpp"

#include <gtest/gtest.h>

#include "cli/plan/debug_text.hpp"

namespace vagus::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Degrees, AreWholeAndBetweenBehindAndBehind) {
    EXPECT_EQ(degrees_shown(0), 0);
    EXPECT_EQ(degrees_shown(-0.4 * kDegree), 0);
    EXPECT_EQ(degrees_shown(90 * kDegree), 90);
    EXPECT_EQ(degrees_shown(179.6 * kDegree), 180);
    EXPECT_EQ(degrees_shown(180 * kDegree), 180);
    EXPECT_EQ(degrees_shown(-180 * kDegree), 180);
    EXPECT_EQ(degrees_shown(-179.6 * kDegree), 180);
    EXPECT_EQ(degrees_shown(-179 * kDegree), -179);
}

// The arena takes whole turns off only above 8 rad.
TEST(Degrees, HaveNoWholeTurns) {
    EXPECT_EQ(degrees_shown(270 * kDegree), -90);
    EXPECT_EQ(degrees_shown(396 * kDegree), 36);
    EXPECT_EQ(degrees_shown(-396 * kDegree), -36);
    EXPECT_EQ(degrees_shown(458 * kDegree), 98);
}

TEST(Degrees, AreWhatThePromptOfAPlanSays) {
    sim::RobotView robot;
    robot.name = "carbot";
    robot.pose = {{1, 2}, 396 * kDegree};
    EXPECT_EQ(text_of(robot), "carbot is at 1.00, 2.00 m, 36 deg\n");
}

}  // namespace
}  // namespace vagus::cli
