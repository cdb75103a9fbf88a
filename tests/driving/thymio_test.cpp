// A Thymio II with examples/thymio/drive.aesl: the driving events of Carbot.
#include <gtest/gtest.h>

#include <cmath>

#include "pilot.hpp"

using namespace vagus;
using namespace std::chrono_literals;

namespace {

constexpr const char* kScript = "thymio/drive.aesl";
constexpr double kDegree = 3.14159265358979 / 180;

// At (0.5, 1) in a room of 3 x 2 m, looking along x. The wall, if there is one, begins at x = 1.5.
sim::WorldDefinition room() {
    sim::WorldDefinition world;
    world.width = 3;
    world.height = 2;
    world.robots.push_back({.name = "thymio", .at = {0.5, 1}});
    return world;
}
sim::WorldDefinition room_with_wall() {
    sim::WorldDefinition world = room();
    world.objects.push_back({.id = "wall", .at = {1.55, 1}, .width = 0.1, .length = 1});
    return world;
}

bool stands(const Pilot& pilot) {
    return pilot.variable("motor.left.speed") == 0 && pilot.variable("motor.right.speed") == 0;
}

// Speeds from slow to more than it can: 10 mm/s, 100 mm/s, 310 mm/s (it drives 166).
class ThymioSpeeds : public testing::TestWithParam<int16_t> {};

TEST_P(ThymioSpeeds, OneMetreEndsWithinACentimetre) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 1000, 0, GetParam()});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 110s));
    EXPECT_TRUE(stands(pilot));
    EXPECT_NEAR(pilot.pose().at.x, 1.5, 0.01);
    EXPECT_NEAR(pilot.pose().at.y, 1, 0.01);
    pilot.send("drive.forward", {8, -300, -1, GetParam()});
    pilot.keep_alive(8);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {8}, 40s));
    EXPECT_NEAR(pilot.pose().at.x, 1.2, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Speeds, ThymioSpeeds, testing::Values(10, 100, 310));

TEST(Thymio, TurnsEndWithinTwoDegrees) {
    Pilot pilot(room(), kScript);
    double heading = 0;
    int16_t token = 1;
    for (const int tenths : {900, -900, 450, -1800, 100, 1800}) {
        pilot.send("drive.turn", {token, static_cast<int16_t>(tenths), 60});
        pilot.keep_alive(token);
        ASSERT_TRUE(pilot.wait_for("drive.arrived", {token}, 10s)) << tenths;
        heading += tenths * kDegree / 10;
        EXPECT_NEAR(std::remainder(pilot.pose().angle - heading, 2 * 180 * kDegree), 0, 2 * kDegree)
            << tenths;
        heading = pilot.pose().angle;
        ++token;
    }
}

// A quarter of a circle of half a metre to the left: half a metre ahead and to the left; then
// backwards, still turning to the left: the middle is on the right.
TEST(Thymio, ACurveEndsWhereItShall) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.curve", {7, 500, 900, 100});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 12s));
    EXPECT_NEAR(pilot.pose().at.x, 1, 0.01);
    EXPECT_NEAR(pilot.pose().at.y, 1.5, 0.01);
    EXPECT_NEAR(pilot.pose().angle, 90 * kDegree, 2 * kDegree);
    sim::WorldDefinition world = room();
    world.robots[0].at.x = 1.5;
    Pilot back(world, kScript);
    back.send("drive.curve", {7, 400, 900, -100});
    back.keep_alive(7);
    ASSERT_TRUE(back.wait_for("drive.arrived", {7}, 12s));
    EXPECT_NEAR(back.pose().at.x, 1.1, 0.01);
    EXPECT_NEAR(back.pose().at.y, 0.6, 0.01);
    EXPECT_NEAR(back.pose().angle, 90 * kDegree, 2 * kDegree);
}

TEST(Thymio, SilenceStopsTheWheelsWithinHalfASecondAndTheSameTokenGoesOn) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 1000, 0, 166});
    pilot.keep_alive(7);
    pilot.step(3s);
    EXPECT_FALSE(stands(pilot));
    pilot.fall_silent();
    pilot.step(500ms);
    EXPECT_TRUE(stands(pilot));
    pilot.step(1s);
    EXPECT_TRUE(stands(pilot));
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 10s));
    EXPECT_NEAR(pilot.pose().at.x, 1.5, 0.01);
}

TEST(Thymio, AfterThreeSecondsOfSilenceTheCommandIsOver) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 1500, 0, 166});
    pilot.keep_alive(7);
    pilot.step(3s);
    pilot.fall_silent();
    pilot.step(2800ms);
    EXPECT_EQ(pilot.count("drive.ended"), 0u);
    EXPECT_TRUE(pilot.wait_for("drive.ended", {7}, 300ms));
    const double x = pilot.pose().at.x;
    pilot.keep_alive(7);
    pilot.step(1s);
    EXPECT_NEAR(pilot.pose().at.x, x, 1e-6);
    EXPECT_GE(pilot.count("drive.ended", {7}), 5u) << "each sign of life is answered";
    pilot.send("drive.forward", {7, 100, 0, 100});
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {7}, 3s));
    const size_t ended = pilot.count("drive.ended");
    pilot.step(1s);
    EXPECT_EQ(pilot.count("drive.ended"), ended) << "it has arrived: that was the answer";
}

TEST(Thymio, SteeringIsASignOfLifeItself) {
    Pilot pilot(room(), kScript);
    for (int i = 0; i < 20; ++i) {
        pilot.send("drive.steer", {7, 100, 200});
        pilot.step(100ms);
    }
    // 2 s at 0.1 m/s and 20 degrees a second.
    EXPECT_NEAR(pilot.pose().angle, 40 * kDegree, 2 * kDegree);
    pilot.step(500ms);
    EXPECT_TRUE(stands(pilot));
}

TEST(Thymio, SomethingNearAheadIsATouchAndItBrakesByItself) {
    Pilot pilot(room_with_wall(), kScript);
    pilot.send("touch.watch", {11});
    pilot.send("touch.watch", {12});
    pilot.send("drive.forward", {7, 2000, 0, 166});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("touched", {0}, 10s));
    EXPECT_EQ(pilot.count("touch.pressed", {11, 0}), 1u);
    EXPECT_EQ(pilot.count("touch.pressed", {12, 0}), 1u);
    // New values of its motors come every 10 ms, and they follow with a time constant of 10 ms.
    pilot.step(100ms);
    EXPECT_TRUE(stands(pilot));
    // Its front is 8 cm ahead of it: the wall is not reached.
    EXPECT_LT(pilot.pose().at.x, 1.42);
    EXPECT_GT(pilot.pose().at.x, 1.38);
    pilot.send("drive.steer", {7, 100, 0});
    pilot.step(500ms);
    EXPECT_TRUE(stands(pilot));
    pilot.send("touch.watch", {13});
    EXPECT_TRUE(pilot.wait_for("touch.pressed", {13, 0}, 3ms));
    pilot.send("drive.forward", {8, -200, -1, 100});
    pilot.keep_alive(8);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {8}, 5s));
    EXPECT_EQ(pilot.count("released", {}), 1u);
    EXPECT_EQ(pilot.count("touched"), 1u);
}

TEST(Thymio, SomethingNearBehindIsTheHalfTurn) {
    sim::WorldDefinition world = room();
    world.robots[0].at.x = 0.3;
    Pilot pilot(world, kScript);
    pilot.send("drive.forward", {7, -1000, -1, 166});
    pilot.keep_alive(7);
    EXPECT_TRUE(pilot.wait_for("touched", {1800}, 5s));
}

TEST(Thymio, AStopIsAnsweredWhenTheWheelsStandAndAnothersAtOnce) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 1000, 0, 166});
    pilot.keep_alive(7);
    pilot.step(1s);
    pilot.send("drive.stop", {6});
    EXPECT_TRUE(pilot.wait_for("drive.stopped", {6}, 3ms));
    EXPECT_FALSE(stands(pilot));
    pilot.send("drive.stop", {7});
    ASSERT_TRUE(pilot.wait_for("drive.stopped", {7}, 200ms));
    EXPECT_TRUE(stands(pilot));
    pilot.step(1s);
    EXPECT_TRUE(stands(pilot));
    EXPECT_EQ(pilot.count("drive.arrived"), 0u);
}

TEST(Thymio, ItSaysWhereItBelievesToBe) {
    Pilot pilot(room(), kScript);
    // From y = -1 mm, looking along y, 100 mm on: the words of y go from -1, -1 to 99, 0.
    pilot.send("drive.place", {4464, 1, -1, -1, 900});
    pilot.send("drive.forward", {7, 100, 0, 100});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 5s));
    pilot.send("drive.ask", {21});
    const auto told = pilot.next("drive.odometry", 5ms);
    ASSERT_TRUE(told);
    EXPECT_EQ((*told)[1], 4464);
    EXPECT_EQ((*told)[2], 1);
    EXPECT_NEAR((*told)[3], 99, 1);
    EXPECT_EQ((*told)[4], 0);
    EXPECT_EQ((*told)[5], 900);
}

}  // namespace
