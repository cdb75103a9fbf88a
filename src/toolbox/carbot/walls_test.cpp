#include "toolbox/carbot/walls.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "toolbox/carbot/test_echo.hpp"

namespace vagus::toolbox::carbot {
namespace {

std::vector<Echo> scan_of(double distance, double normal, double from, double to, double step) {
    std::vector<Echo> echoes;
    for (double angle = from; angle <= to; angle += step) {
        echoes.push_back(look_at(distance, normal, angle));
    }
    return echoes;
}

// Worked out by hand: a wall 50 cm to the right. The look at -90 hears 50, that at -55 is 35
// degrees off, of which the cone takes 12: 50 / cos 23 = 54.32.
TEST(Walls, TwoLooksGiveDistanceAndDirection) {
    const auto wall = fit_wall({{-90, 50}, {-55, 54.32}});
    ASSERT_TRUE(wall.has_value());
    EXPECT_NEAR(wall->distance_cm, 50, 0.1);
    EXPECT_NEAR(wall->normal_deg, -90, 0.6);
    EXPECT_NEAR(wall->turn_to_have_it_right(), 0, 0.6);
    EXPECT_NEAR(std::abs(wall->turn_to_have_it_left()), 180, 0.6);
}

TEST(Walls, ATiltedWallIsSeenTilted) {
    for (const double tilt : {-20.0, -10.0, 10.0, 20.0}) {
        const auto wall = fit_wall({look_at(40, 90 + tilt, 90), look_at(40, 90 + tilt, 55)});
        ASSERT_TRUE(wall.has_value());
        EXPECT_NEAR(wall->normal_deg, 90 + tilt, 1) << tilt;
        EXPECT_NEAR(wall->turn_to_have_it_left(), tilt, 1) << tilt;
    }
}

TEST(Walls, AScanFindsTheNearestWallWhereverItIs) {
    for (double normal = -110; normal <= 110; normal += 5) {
        const auto wall = nearest_wall(scan_of(80, normal, -120, 120, 10));
        ASSERT_TRUE(wall.has_value()) << normal;
        EXPECT_NEAR(wall->normal_deg, normal, 1) << normal;
        EXPECT_NEAR(wall->distance_cm, 80, 0.5) << normal;
    }
}

// Of a corner the nearer wall counts: 60 cm ahead, and 100 cm to the left.
TEST(Walls, InACornerTheNearerWallCounts) {
    std::vector<Echo> echoes;
    for (double angle = -120; angle <= 120; angle += 10) {
        const Echo ahead = look_at(60, 0, angle);
        const Echo left = look_at(100, 90, angle);
        const bool nearer = ahead.distance_cm > 0 &&
                            (left.distance_cm == 0 || ahead.distance_cm < left.distance_cm);
        echoes.push_back(nearer ? ahead : left);
    }
    const auto wall = nearest_wall(echoes);
    ASSERT_TRUE(wall.has_value());
    EXPECT_NEAR(wall->normal_deg, 0, 8);
    EXPECT_NEAR(wall->distance_cm, 60, 3);
}

// The next wall ahead, 30 cm from the sensor, and that at the right, 28 cm from it.
TEST(Walls, OnlyWallsInTheSectorCount) {
    std::vector<Echo> echoes;
    for (double angle = -120; angle <= 120; angle += 10) {
        const Echo ahead = look_at(30, 0, angle);
        const Echo right = look_at(28, -90, angle);
        const bool nearer = ahead.distance_cm > 0 &&
                            (right.distance_cm == 0 || ahead.distance_cm < right.distance_cm);
        echoes.push_back(nearer ? ahead : right);
    }
    const auto any = nearest_wall(echoes);
    ASSERT_TRUE(any.has_value());
    EXPECT_NEAR(any->normal_deg, -90, 2);
    const auto in_the_way = nearest_wall(echoes, {.to_side_deg = 45});
    ASSERT_TRUE(in_the_way.has_value());
    EXPECT_NEAR(in_the_way->normal_deg, 0, 2);
    EXPECT_FALSE(nearest_wall(echoes, {.reach_cm = 27}).has_value());
}

TEST(Walls, NoEchoOrALonelyOneIsNoWall) {
    EXPECT_FALSE(nearest_wall({}).has_value());
    EXPECT_FALSE(nearest_wall({{0, 0}, {10, 0}}).has_value());
    EXPECT_FALSE(nearest_wall({{0, 0}, {10, 50}, {20, 0}}).has_value());
    EXPECT_FALSE(fit_wall({{0, 50}, {10, 0}}).has_value());
}

TEST(Walls, AnglesStayAboveMinusAHalfTurn) {
    EXPECT_EQ(normal_angle(190), -170);
    EXPECT_EQ(normal_angle(-180), 180);
    EXPECT_EQ(normal_angle(540), 180);
    EXPECT_EQ(normal_angle(-45), -45);
}

}  // namespace
}  // namespace vagus::toolbox::carbot
