#include "toolbox/carbot/spots.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "toolbox/carbot/test_echo.hpp"
#include "toolbox/carbot/walls.hpp"

namespace vagus::toolbox::carbot {
namespace {

// By hand: a wall 50 cm to the right of the sensor, which is 18 cm ahead of the middle. The
// looks at -100, -90 and -80 hear 50: one spot in the middle of them, at (18, -50). That at -60 is
// 18 degrees off the cone: 50 / cos 18 = 52.57, heard at the edge of the cone, at -72 degrees.
TEST(Spots, LieOnTheWall) {
    const auto look = [](double angle) { return look_at(50, -90, angle); };
    const std::vector<Spot> spots =
        spots_of({{{}, look(-100)}, {{}, look(-90)}, {{}, look(-80)}, {{}, look(-60)}});
    ASSERT_EQ(spots.size(), 2u);
    EXPECT_NEAR(spots[0].x_cm, 18, 0.1);
    EXPECT_NEAR(spots[0].y_cm, -50, 0.1);
    EXPECT_NEAR(spots[1].x_cm, 18 + 50 * std::tan(18 * kDegree), 0.1);
    EXPECT_NEAR(spots[1].y_cm, -50, 0.1);
}

// From another pose: at (100, 50) and looking along y, what is at the right is beyond in x.
TEST(Spots, AreInTheFrameOfThePoses) {
    const Pose pose{100, 50, 90};
    const std::vector<Spot> spots = spots_of({{pose, {-90, 40}}});
    ASSERT_EQ(spots.size(), 1u);
    EXPECT_NEAR(spots[0].x_cm, 140, 1e-9);
    EXPECT_NEAR(spots[0].y_cm, 68, 1e-9);
    EXPECT_NEAR(seen_from(pose, spots[0]).x_cm, 18, 1e-9);
    EXPECT_NEAR(seen_from(pose, spots[0]).y_cm, -40, 1e-9);
    EXPECT_NEAR(placed(pose, {18, -40}).x_cm, 140, 1e-9);
}

TEST(Spots, NothingHeardIsNoSpot) {
    EXPECT_TRUE(spots_of({}).empty());
    EXPECT_TRUE(spots_of({{{}, {0, 0}}, {{}, {10, 0}}}).empty());
}

// In the depth of a corner both neighbours are nearer: nobody knows which wall was heard.
TEST(Spots, TheDepthOfACornerIsNoSpot) {
    EXPECT_EQ(spots_of({{{}, {-10, 50}}, {{}, {0, 60}}, {{}, {10, 50}}}).size(), 2u);
}

}  // namespace
}  // namespace vagus::toolbox::carbot
