#include "toolbox/carbot/wall_steering.hpp"

#include <gtest/gtest.h>

namespace vagus::toolbox::carbot {
namespace {

constexpr AlongWall kGoal{.distance_cm = 30, .speed_cm = 20, .gain = 1};
constexpr double kAbeam = 30 + kHalfWidthCm;  // from the middle, at the right distance

// Spots on a line at `y`, every 5 cm.
WallMap wall_along_x(double from_x, double to_x, double y) {
    WallMap map(200);
    for (double x = from_x; x <= to_x; x += 5) map.assume({x, y});
    return map;
}

TEST(WallMap, TellsTheNearestOfEachSideAndWhatIsAheadAsRight) {
    WallMap map(200);
    EXPECT_EQ(map.distances_from({}).right_cm, kMapReachCm);
    map.assume({0, -40});
    map.assume({10, 60});
    EXPECT_EQ(map.distances_from({}).right_cm, 40);
    EXPECT_NEAR(map.distances_from({}).left_cm, 60.83, 0.01);
    EXPECT_NEAR(map.distances_from({0, 0, 180}).right_cm, 60.83, 0.01);  // turned around
    map.assume({30, 5});                                                 // 9 degrees off ahead
    EXPECT_NEAR(map.distances_from({}).right_cm, 30.41, 0.01);
}

// The looks at -105 and at 30 degrees bound what is in sight. Nothing is heard now: what is ahead
// is not there any more, what is behind the sensor's sight stays.
TEST(WallMap, WhatIsInSightIsSeenAnewAndTheRestRemembered) {
    WallMap map(200);
    map.assume({60, -20});
    map.assume({-20, -47});
    map.take({{{}, {-105, 0}}, {{}, {30, 0}}});
    EXPECT_EQ(map.size(), 1u);
    EXPECT_NEAR(map.distances_from({}).right_cm, 51.08, 0.01);
}

TEST(WallMap, WhatWasSeenLongAgoOrIsFarAwayIsForgotten) {
    WallMap map(200);
    map.take({{{}, {0, 0}}});
    map.assume({0, -47});
    map.take({{{60, 0, 0}, {90, 0}}});
    EXPECT_EQ(map.size(), 1u);
    map.take({{{160, 0, 0}, {90, 0}}});  // 178 cm from the sensor
    EXPECT_EQ(map.size(), 0u);

    map.assume({160, -47});
    for (int round = 0; round < 4; ++round) {  // 50 cm each
        map.take({{{135, 0, 0}, {90, 0}}});
        map.take({{{160, 0, 0}, {90, 0}}});
    }
    EXPECT_EQ(map.size(), 1u);
    map.take({{{170, 0, 0}, {90, 0}}});
    EXPECT_EQ(map.size(), 0u);
}

// One more than the limit, all of them behind the sensor's sight.
TEST(WallMap, HoldsSoManySpotsAndNoMore) {
    WallMap map(200);
    for (size_t i = 0; i <= kMapSpotsMax; ++i) map.assume({-20, -40});
    EXPECT_EQ(map.size(), kMapSpotsMax + 1);
    map.take({{{}, {90, 0}}});
    EXPECT_EQ(map.size(), kMapSpotsMax);
}

TEST(WallSteering, GoesStraightOnAlongAWallAtTheRightDistance) {
    const Steering steering = steer_along(wall_along_x(-60, 120, -kAbeam), {}, kGoal);
    EXPECT_EQ(steering.rate_deg, 0);
    EXPECT_EQ(steering.speed_cm, 20);
}

TEST(WallSteering, GoesNearerOrAway) {
    EXPECT_LT(steer_along(wall_along_x(-60, 120, -kAbeam - 15), {}, kGoal).rate_deg, 0);
    EXPECT_GT(steer_along(wall_along_x(-60, 120, -kAbeam + 15), {}, kGoal).rate_deg, 0);
}

// The wall ends beside the robot. A circle around its end at the right distance: 20 cm/s by 47.5 cm
// is 24 degrees a second; the nearest rates that it tries are 20 and 30.
TEST(WallSteering, GoesAroundTheEndOfTheWall) {
    const double rate = steer_along(wall_along_x(-60, 0, -kAbeam), {}, kGoal).rate_deg;
    EXPECT_LE(rate, -10);
    EXPECT_GE(rate, -30);
}

// In a corner: the wall at the right, and the next one 60 cm ahead of the middle.
TEST(WallSteering, TurnsFromOneWallIntoTheNext) {
    WallMap map = wall_along_x(-60, 60, -kAbeam);
    for (double y = -kAbeam; y <= 60; y += 5) map.assume({60, y});
    EXPECT_GT(steer_along(map, {}, kGoal).rate_deg, 20);
}

// What is at the left does not draw it, but keeps it away: at the right distance from the wall, and
// 25 cm too near to a thing at the left.
TEST(WallSteering, KeepsAwayFromWhatIsAtTheLeft) {
    WallMap map = wall_along_x(-60, 120, -kAbeam);
    map.assume({35, 30});
    EXPECT_LT(steer_along(map, {}, kGoal).rate_deg, 0);
    map = wall_along_x(-60, 120, -kAbeam);
    map.assume({35, 70});
    EXPECT_EQ(steer_along(map, {}, kGoal).rate_deg, 0);
}

}  // namespace
}  // namespace vagus::toolbox::carbot
