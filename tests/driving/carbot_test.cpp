// Carbot with its scripts, as docs/carbot.md promises it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "pilot.hpp"

using namespace vagus;
using namespace std::chrono_literals;

namespace {

constexpr const char* kScript = "carbot/carbot.aesl";
constexpr double kDegree = 3.14159265358979 / 180;

// At (1, 2) in a room of 5 x 4 m, looking along x. A wall, if there is one, begins at x = 3.
sim::WorldDefinition room() {
    sim::WorldDefinition world;
    world.width = 5;
    world.height = 4;
    world.robots.push_back({.name = "carbot", .type = sim::RobotType::Carbot, .at = {1, 2}});
    return world;
}
sim::WorldDefinition room_with_wall() {
    sim::WorldDefinition world = room();
    world.objects.push_back(
        {.id = "wall", .at = {3.05, 2}, .width = 0.1, .length = 2, .height = 0.5});
    return world;
}

// A wall that is met straight presses the whole front, or one of its corners a moment earlier.
bool is_ahead(const std::optional<std::vector<int16_t>>& arguments, size_t index = 0) {
    return arguments && index < arguments->size() && std::abs((*arguments)[index]) <= 300;
}

bool stands(const Pilot& pilot) {
    return pilot.variable("wheel.front.speed") == 0 && pilot.variable("wheel.rear.speed") == 0;
}

class CarbotSeeds : public testing::TestWithParam<uint64_t> {};

TEST_P(CarbotSeeds, OneMetreEndsWithinACentimetre) {
    Pilot pilot(room(), kScript, GetParam());
    pilot.send("drive.forward", {7, 1000, 0, 200});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 7s));
    EXPECT_TRUE(stands(pilot));
    EXPECT_NEAR(pilot.pose().at.x, 2, 0.01);
    EXPECT_NEAR(pilot.pose().at.y, 2, 0.01);
    pilot.step(1s);
    EXPECT_EQ(pilot.count("drive.arrived", {7}), 1u);
}

TEST_P(CarbotSeeds, AQuarterTurnEndsWithinTwoDegreesAndInPlace) {
    Pilot pilot(room(), kScript, GetParam());
    pilot.send("drive.turn", {7, -900, 45});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 4s));
    EXPECT_NEAR(pilot.pose().angle, -90 * kDegree, 2 * kDegree);
    EXPECT_NEAR(pilot.pose().at.x, 1, 0.01);
    EXPECT_NEAR(pilot.pose().at.y, 2, 0.01);
}

// A quarter of a circle of 0.8 m to the left: 0.8 m ahead and 0.8 m to the left.
TEST_P(CarbotSeeds, AQuarterOfACircleEndsWhereItShall) {
    Pilot pilot(room(), kScript, GetParam());
    pilot.send("drive.curve", {7, 800, 900, 250});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 8s));
    EXPECT_NEAR(pilot.pose().at.x, 1.8, 0.02);
    EXPECT_NEAR(pilot.pose().at.y, 2.8, 0.02);
    EXPECT_NEAR(pilot.pose().angle, 90 * kDegree, 2 * kDegree);
}

INSTANTIATE_TEST_SUITE_P(Seeds, CarbotSeeds, testing::Range<uint64_t>(1, 9));

TEST(Carbot, ADistanceBeyondAWordTravelsInTwo) {
    sim::WorldDefinition world = room();
    world.width = 40;
    Pilot pilot(world, kScript);
    // 35 m are 35000 mm: low word 35000 - 65536, high word 0.
    pilot.send("drive.forward", {7, 35000 - 65536, 0, 310});
    pilot.keep_alive(7);
    EXPECT_FALSE(pilot.wait_for("drive.arrived", {7}, 110s));
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {7}, 10s));
    // Backwards by 1 m: -1000 is low word -1000, high word -1.
    const sim::Pose far = pilot.pose();
    pilot.send("drive.forward", {8, -1000, -1, 200});
    pilot.keep_alive(8);
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {8}, 7s));
    EXPECT_NEAR(std::hypot(pilot.pose().at.x - far.at.x, pilot.pose().at.y - far.at.y), 1, 0.01);
    EXPECT_LT(pilot.pose().at.x, far.at.x);
}

// The last sign of life came 100 ms before the silence begins at the latest: the wheels stand
// within half a second, at the highest speed.
TEST(Carbot, SilenceStopsTheWheelsWithinHalfASecondAndTheSameTokenGoesOn) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 2000, 0, 310});
    pilot.keep_alive(7);
    pilot.step(3s);
    EXPECT_EQ(pilot.variable("wheel.front.speed"), 310);
    pilot.fall_silent();
    pilot.step(250ms);
    EXPECT_FALSE(stands(pilot)) << "one message may be late";
    pilot.step(250ms);
    EXPECT_TRUE(stands(pilot));
    const double x = pilot.pose().at.x;
    pilot.step(2s);
    EXPECT_NEAR(pilot.pose().at.x, x, 1e-6);
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 10s));
    EXPECT_NEAR(pilot.pose().at.x, 3, 0.015);
}

TEST(Carbot, NoWayAtAllIsDoneAtOnce) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 0, 0, 200});
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {7}, 20ms));
    pilot.send("drive.turn", {8, 0, 45});
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {8}, 20ms));
    pilot.send("drive.curve", {9, 500, 0, 200});
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {9}, 20ms));
}

// Beyond the ranges the nearest value inside counts: 310 mm/s, 1 mm, 136 degrees a second.
TEST(Carbot, WhatIsOutOfRangeIsTakenAsTheNearestInside) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 1000, 0, 32767});
    pilot.step(200ms);
    pilot.keep_alive(7);
    pilot.step(1800ms);
    EXPECT_EQ(pilot.variable("wheel.front.speed"), 310);
    pilot.send("drive.turn", {8, 1800, 32767});
    pilot.keep_alive(8);
    pilot.step(1s);
    EXPECT_LE(pilot.variable("wheel.front.speed"), 310);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {8}, 3s));
    pilot.send("drive.curve", {9, -32768, 900, -32768});
    pilot.keep_alive(9);
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {9}, 5s));
    pilot.send("drive.forward", {10, 3, 0, -5});
    pilot.keep_alive(10);
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {10}, 5s)) << "the slowest speed, 1 mm/s";
}

TEST(Carbot, AnotherTokensSignOfLifeDoesNotCount) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 2000, 0, 310});
    pilot.keep_alive(8);
    pilot.step(600ms);
    EXPECT_TRUE(stands(pilot));
}

TEST(Carbot, SteeringIsASignOfLifeItself) {
    Pilot pilot(room(), kScript);
    for (int i = 0; i < 20; ++i) {
        pilot.send("drive.steer", {7, 200, 100});
        pilot.step(100ms);
    }
    EXPECT_NEAR(pilot.variable("wheel.front.speed"), 200, 3);
    pilot.step(500ms);
    EXPECT_TRUE(stands(pilot));
    pilot.send("drive.steer", {7, 200, 0});
    pilot.step(200ms);
    EXPECT_FALSE(stands(pilot));
}

// The bumper senses 1 ms after the physics, its event reaches the drive node 1 ms later, and the
// wheels hear of it in the next step of 10 ms; from 310 mm/s to less than 1 mm/s they take
// 30 ms * ln 310 = 172 ms. No host has a part in it.
TEST(Carbot, ATouchBrakesWithoutAnyHost) {
    Pilot pilot(room_with_wall(), kScript);
    pilot.send("drive.forward", {7, 5000, 0, 310});
    pilot.keep_alive(7);
    ASSERT_TRUE(is_ahead(pilot.next("touched", 10s)));
    EXPECT_NEAR(pilot.pose().at.x, 2.8, 0.01) << "the hull reaches 0.2 m ahead";
    pilot.step(15ms);
    EXPECT_LT(pilot.variable("wheel.front.speed"), 310);
    pilot.step(175ms);
    EXPECT_TRUE(stands(pilot));
    // Signs of life, and commands with the same token, do not drive on.
    pilot.send("drive.steer", {7, 300, 0});
    pilot.step(1s);
    EXPECT_TRUE(stands(pilot));
    EXPECT_EQ(pilot.count("drive.arrived", {7}), 0u);
    EXPECT_EQ(pilot.count("touched"), 1u) << "one touch is told once";
    // Another token may drive away while the wall is still touched.
    EXPECT_GT(pilot.variable("touch.count"), 0);
    pilot.send("drive.forward", {8, -300, -1, 200});
    pilot.keep_alive(8);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {8}, 4s));
    EXPECT_EQ(pilot.count("released", {}), 1u);
    EXPECT_NEAR(pilot.pose().at.x, 2.5, 0.02);
}

TEST(Carbot, ATouchBehindIsTheHalfTurnAndOneAtACornerIsBeside) {
    sim::WorldDefinition world = room();
    world.robots[0].at = {0.4, 2};
    Pilot back(world, kScript);
    back.send("drive.forward", {7, -1000, -1, 100});
    back.keep_alive(7);
    EXPECT_TRUE(back.wait_for("touched", {1800}, 5s));
    // At 45 degrees the corner of the front and the left side comes first: it lies at 38 degrees
    // (0.185, 0.16), which is sector 1.
    world.robots[0].at = {4, 2};
    world.robots[0].angle = -45 * kDegree;
    Pilot corner(world, kScript);
    corner.send("drive.forward", {7, 3000, 0, 200});
    corner.keep_alive(7);
    EXPECT_TRUE(corner.wait_for("touched", {300}, 10s));
}

TEST(Carbot, AStopIsAnsweredWhenTheWheelsStand) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 2000, 0, 310});
    pilot.keep_alive(7);
    pilot.step(2s);
    pilot.send("drive.stop", {7});
    ASSERT_TRUE(pilot.wait_for("drive.stopped", {7}, 250ms));
    EXPECT_LE(std::abs(pilot.variable("wheel.front.speed")), 1);
    const double x = pilot.pose().at.x;
    pilot.step(2s);
    EXPECT_NEAR(pilot.pose().at.x, x, 0.001) << "its signs of life mean nothing any more";
    EXPECT_EQ(pilot.count("drive.arrived", {7}), 0u);
}

TEST(Carbot, AStopOfAnotherTokenIsAnsweredAtOnceAndStopsNothing) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 2000, 0, 310});
    pilot.keep_alive(7);
    pilot.step(2s);
    pilot.send("drive.stop", {6});
    EXPECT_TRUE(pilot.wait_for("drive.stopped", {6}, 3ms));
    pilot.step(1s);
    EXPECT_EQ(pilot.variable("wheel.front.speed"), 310);
}

TEST(Carbot, ACommandThatTakesTheWheelsAnswersTheStopBeforeIt) {
    Pilot pilot(room(), kScript);
    pilot.send("drive.forward", {7, 2000, 0, 310});
    pilot.keep_alive(7);
    pilot.step(2s);
    pilot.send("drive.stop", {7});
    pilot.step(2ms);
    pilot.send("drive.turn", {8, 900, 60});
    pilot.keep_alive(8);
    EXPECT_TRUE(pilot.wait_for("drive.stopped", {7}, 3ms));
    EXPECT_TRUE(pilot.wait_for("drive.arrived", {8}, 5s));
    EXPECT_EQ(pilot.count("drive.stopped", {7}), 1u);
}

TEST(Carbot, AStopAfterATouchIsAnsweredToo) {
    Pilot pilot(room_with_wall(), kScript);
    pilot.send("drive.forward", {7, 5000, 0, 310});
    pilot.keep_alive(7);
    ASSERT_TRUE(is_ahead(pilot.next("touched", 10s)));
    pilot.send("drive.stop", {7});
    EXPECT_TRUE(pilot.wait_for("drive.stopped", {7}, 250ms));
}

TEST(Carbot, EachWatcherOfTouchesHearsItWithItsToken) {
    Pilot pilot(room_with_wall(), kScript);
    pilot.send("touch.watch", {11});
    pilot.send("touch.watch", {12});
    pilot.send("drive.forward", {7, 5000, 0, 310});
    pilot.keep_alive(7);
    const auto pressed = pilot.next("touch.pressed", 10s);
    ASSERT_TRUE(is_ahead(pressed, 1));
    const int16_t sector = (*pressed)[1];
    pilot.step(1s);
    EXPECT_EQ(pilot.count("touch.pressed", {11, sector}), 1u);
    EXPECT_EQ(pilot.count("touch.pressed", {12, sector}), 1u);
    EXPECT_EQ(pilot.count("touch.pressed"), 2u);
    // Who comes while the wall is touched hears it at once.
    pilot.send("touch.watch", {13});
    EXPECT_TRUE(pilot.wait_for("touch.pressed", {13, sector}, 3ms));
    // Away, and again: 12 has left meanwhile.
    pilot.send("touch.unwatch", {12});
    pilot.send("drive.forward", {8, -200, -1, 300});
    pilot.keep_alive(8);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {8}, 5s));
    pilot.send("drive.forward", {9, 1000, 0, 300});
    pilot.keep_alive(9);
    const auto again = pilot.next("touch.pressed", 5s);
    ASSERT_TRUE(is_ahead(again, 1));
    EXPECT_EQ((*again)[0], 11);
    pilot.step(100ms);
    EXPECT_EQ(pilot.count("touch.pressed"), 5u) << "two, one, and now 11 and 13";
}

TEST(Carbot, AFifthWatcherTakesThePlaceOfTheOldest) {
    Pilot pilot(room(), kScript);
    for (int16_t token = 11; token <= 15; ++token) pilot.send("escape.watch", {token});
    pilot.step(5ms);
    ASSERT_TRUE(pilot.world().press({1}, "escape").ok());
    ASSERT_TRUE(pilot.wait_for("escape.pressed", {15}, 5ms));
    pilot.step(5ms);
    EXPECT_EQ(pilot.count("escape.pressed", {11}), 0u);
    for (int16_t token = 12; token <= 15; ++token)
        EXPECT_EQ(pilot.count("escape.pressed", {token}), 1u) << token;
}

TEST(Carbot, TheEscapeButtonIsToldToEverybodyAndToItsWatchers) {
    Pilot pilot(room(), kScript);
    pilot.send("escape.watch", {11});
    pilot.step(5ms);
    ASSERT_TRUE(pilot.world().press({1}, "escape").ok());
    EXPECT_TRUE(pilot.wait_for("escape", {1}, 5ms));
    EXPECT_EQ(pilot.count("escape.pressed", {11}), 1u);
    pilot.send("escape.watch", {12});
    EXPECT_TRUE(pilot.wait_for("escape.pressed", {12}, 3ms)) << "it is held";
    ASSERT_TRUE(pilot.world().release({1}, "escape").ok());
    EXPECT_TRUE(pilot.wait_for("escape", {0}, 5ms));
    pilot.send("escape.watch", {13});
    pilot.step(10ms);
    EXPECT_EQ(pilot.count("escape.pressed", {13}), 0u);
    EXPECT_EQ(pilot.count("escape.pressed", {11}), 1u);
}

// ---- the way: so many millimetres, within so many tenths of a second ----

TEST(Carbot, WhoWatchesTheWayHearsEachTimeThatItStays) {
    Pilot pilot(room(), kScript);
    pilot.send("way.watch", {9, 200, 10});
    pilot.step(950ms);
    EXPECT_EQ(pilot.count("way.none"), 0u);
    EXPECT_TRUE(pilot.wait_for("way.none", {9}, 100ms));
    pilot.step(2s);
    EXPECT_EQ(pilot.count("way.none", {9}), 3u);
    pilot.send("way.unwatch", {9});
    pilot.step(2s);
    EXPECT_EQ(pilot.count("way.none"), 3u);
}

// 60 cm at 20 cm/s, 20 cm within 2 s each; then it is at rest.
TEST(Carbot, WhatGetsOnHasMadeItsWay) {
    Pilot pilot(room(), kScript);
    pilot.send("way.watch", {9, 200, 20});
    pilot.send("drive.forward", {7, 600, 0, 200});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 5s));
    EXPECT_EQ(pilot.count("way.none"), 0u);
    EXPECT_TRUE(pilot.wait_for("way.none", {9}, 2100ms));
}

// 15 cm to and 15 cm fro take about 2 s: a way, but it does not lead 20 cm away.
TEST(Carbot, GoingToAndFroIsNoWay) {
    Pilot pilot(room(), kScript);
    pilot.send("way.watch", {9, 200, 30});
    constexpr int16_t kForwardToken = 11;
    constexpr int16_t kBackToken = 12;
    for (int times = 0; times < 2; ++times) {
        pilot.keep_alive(kForwardToken);
        pilot.send("drive.forward", {kForwardToken, 150, 0, 200});
        ASSERT_TRUE(pilot.wait_for("drive.arrived", {kForwardToken}, 2s));
        pilot.keep_alive(kBackToken);
        pilot.send("drive.forward", {kBackToken, -150, -1, 200});
        ASSERT_TRUE(pilot.wait_for("drive.arrived", {kBackToken}, 2s));
    }
    EXPECT_EQ(pilot.count("way.none", {9}), 1u);
}

TEST(Carbot, APlaceThatIsSetIsNoWay) {
    Pilot pilot(room(), kScript);
    pilot.send("way.watch", {9, 200, 10});
    pilot.step(600ms);
    pilot.send("drive.place", {5000, 0, 0, 0, 0});
    pilot.step(900ms);
    EXPECT_EQ(pilot.count("way.none"), 0u) << "it counts from there";
    EXPECT_TRUE(pilot.wait_for("way.none", {9}, 150ms));
}

TEST(Carbot, AFifthWatcherOfTheWayTakesThePlaceOfTheOldest) {
    Pilot pilot(room(), kScript);
    for (int16_t token = 11; token <= 15; ++token) pilot.send("way.watch", {token, 200, 10});
    pilot.step(1500ms);
    EXPECT_EQ(pilot.count("way.none", {11}), 0u);
    for (int16_t token = 12; token <= 15; ++token)
        EXPECT_EQ(pilot.count("way.none", {token}), 1u) << token;
}

TEST(Carbot, ItSaysWhereItBelievesToBe) {
    Pilot pilot(room(), kScript);
    // 70 m are 70000 mm: 1 * 65536 + 4464.
    pilot.send("drive.place", {4464, 1, -500, -1, 900});
    pilot.step(5ms);
    pilot.send("drive.ask", {21});
    EXPECT_TRUE(pilot.wait_for("drive.odometry", {21, 4464, 1, -500, -1, 900}, 5ms));
    // Half a metre along its own y: -500 + 500 is 0, within what the last millimetre rounds to.
    pilot.send("drive.forward", {7, 500, 0, 200});
    pilot.keep_alive(7);
    ASSERT_TRUE(pilot.wait_for("drive.arrived", {7}, 5s));
    EXPECT_NEAR(pilot.variable("odometry.y"), 0, 2);
    EXPECT_NEAR(pilot.variable("odometry.x"), 4464, 1);
    EXPECT_EQ(pilot.variable("odometry.heading"), 900);
}

TEST(Carbot, TheSameSeedIsTheSameRunAndAnotherSlipsDifferently) {
    const auto run = [](uint64_t seed) {
        Pilot pilot(room_with_wall(), kScript, seed);
        pilot.send("drive.curve", {7, 900, 1200, 300});
        pilot.keep_alive(7);
        pilot.step(10s);
        return pilot.trace();
    };
    const std::string first = run(1);
    EXPECT_EQ(first, run(1));
    EXPECT_NE(first, run(2));
}

// FNV-1a over the bits of the poses, every 10 ms.
uint64_t hash_of_drive() {
    Pilot pilot(room_with_wall(), kScript, 3);
    uint64_t hash = 0xcbf29ce484222325u;
    const auto drive = [&](Duration span) {
        for (Duration done{}; done < span; done += 10ms) {
            pilot.step(10ms);
            const sim::Pose pose = pilot.pose();
            for (const double value : {pose.at.x, pose.at.y, pose.angle}) {
                unsigned char bytes[sizeof value];
                std::memcpy(bytes, &value, sizeof value);
                for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
            }
        }
    };
    pilot.send("drive.curve", {7, 900, 600, 300});
    pilot.keep_alive(7);
    drive(5s);
    pilot.send("drive.turn", {8, -1100, 90});
    pilot.keep_alive(8);
    drive(3s);
    pilot.send("drive.forward", {9, 3000, 0, 310});
    pilot.keep_alive(9);
    drive(8s);
    return hash;
}

// Changes when the way in which Carbot drives or slips changes: then look whether that was meant.
TEST(Carbot, TheDriveOfSixteenSecondsIsTheGoldenOne) {
    EXPECT_EQ(hash_of_drive(), 2245115350268015587u);
}

}  // namespace
