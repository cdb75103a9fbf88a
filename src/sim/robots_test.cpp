// The bodies of the robots against the measurements of docs/sensors.md.
#include <gtest/gtest.h>

#include <cmath>

#include "base/trig.hpp"
#include "sim/epuck/body.hpp"
#include "sim/ground.hpp"
#include "sim/thymio2/body.hpp"

using namespace vagus;
using namespace vagus::sim;

namespace {

// A wall with its near face `distance` metres from the middle of a robot at (1, 1), straight ahead.
void add_wall(Arena& arena, double distance) {
    arena.add_object({.id = "",
                      .kind = ObjectKind::Wall,
                      .at = {1 + distance + 0.005, 1},
                      .width = 0.01,
                      .length = 0.44});
}

std::array<int16_t, 7> thymio_before_wall(double distance, double angle) {
    Arena arena({.width = 2, .height = 2});
    add_wall(arena, distance);
    const thymio2::Body body(arena, {{1, 1}, angle});
    arena.prepare_looks();
    Noise noise(1);
    return body.look(arena, noise).values;
}

struct Measured {
    double distance;  // m
    double reading;
};

// Noise is below 4 times 2.7; the formula is within 1.5 % of what was measured.
void expect_reading(double reading, double expected, const char* what) {
    EXPECT_NEAR(reading, expected, 12 + 0.015 * expected) << what;
}

TEST(Thymio2Body, TheFrontSensorReadsWhatWasMeasured) {
    const Measured table[] = {{0.085, 4489}, {0.09, 4442}, {0.10, 4265}, {0.11, 4004},
                              {0.12, 3687},  {0.13, 3348}, {0.14, 3008}, {0.15, 2689},
                              {0.16, 2394},  {0.18, 1896}, {0.20, 1512}, {0.215, 1286},
                              {0.22, 0},     {0.27, 0}};
    for (const Measured& row : table) {
        SCOPED_TRACE(row.distance);
        expect_reading(thymio_before_wall(row.distance, 0)[2], row.reading, "front");
    }
}

TEST(Thymio2Body, TheBackSensorsReadWhatWasMeasured) {
    const Measured table[] = {{0.04, 4442}, {0.06, 4005}, {0.08, 3348}, {0.10, 2689},
                              {0.13, 1896}, {0.16, 1357}, {0.175, 0}};
    for (const Measured& row : table) {
        SCOPED_TRACE(row.distance);
        const auto values = thymio_before_wall(row.distance, trig::kPi);
        expect_reading(values[5], row.reading, "left");
        expect_reading(values[6], row.reading, "right");
        EXPECT_EQ(values[2], 0);
    }
}

// Turned to the left by 20 degrees the wall is to the right: sensor 3 looks straight at it.
TEST(Thymio2Body, ATurnedRobotSeesTheWallWithItsOtherSensors) {
    const auto values = thymio_before_wall(0.11, trig::kPi / 9);
    expect_reading(values[3], 3996, "right of the middle");
    expect_reading(values[4], 3762, "rightmost");
    const auto mirrored = thymio_before_wall(0.11, -trig::kPi / 9);
    expect_reading(mirrored[1], 3996, "left of the middle");
    expect_reading(mirrored[0], 3761, "leftmost");
}

TEST(Thymio2Body, AThinPostBetweenTwoSensorsIsSeen) {
    Arena arena({.width = 2, .height = 2});
    // 10 degrees to the left of ahead, 12 cm from the middle: between the rays of sensors 1 and 2.
    arena.add_object({.id = "",
                      .kind = ObjectKind::Cylinder,
                      .at = {1 + 0.16 * trig::cos(0.35), 1 + 0.16 * trig::sin(0.35)},
                      .radius = 0.01});
    const thymio2::Body body(arena, {{1, 1}, 0});
    arena.prepare_looks();
    Noise noise(1);
    const auto values = body.look(arena, noise).values;
    EXPECT_GT(*std::max_element(values.begin(), values.end()), 1000);
}

TEST(Thymio2Body, GroundSensorsReadWhatWasMeasured) {
    const double table[] = {75, 98, 150, 253, 423, 617, 773, 865, 909, 929, 938};
    for (int tenth = 0; tenth <= 10; ++tenth) {
        const double level = tenth / 10.0;
        EXPECT_NEAR(thymio2::ground_reading(level), table[tenth], 1e-9);
        Arena arena({.width = 2, .height = 2});
        const thymio2::Body body(arena, {{1, 1}, 0});
        const Ground ground(2, 2, {level, level, level});
        Noise noise(3);
        const auto down = body.look_down(arena.pose(body.id()), ground, noise);
        for (const int16_t reading : down.reflected) EXPECT_NEAR(reading, table[tenth], 36);
        EXPECT_EQ(down.ambient[0], 0);
    }
}

// The left sensor is 7.2 cm ahead and 1.2 cm to the left, the right one as far to the right.
TEST(Thymio2Body, EachGroundSensorSeesItsOwnSpot) {
    Arena arena({.width = 2, .height = 2});
    const thymio2::Body body(arena, {{1, 1}, trig::kPi / 2});
    Ground ground(2, 2, {1, 1, 1});
    ground.set_patches({{.id = "",
                         .kind = ObjectKind::Patch,
                         .at = {1 - 0.012, 1 + 0.072},
                         .radius = 0.005,
                         .colour = {0, 0, 0}}});
    Noise noise(3);
    const auto down = body.look_down(arena.pose(body.id()), ground, noise);
    EXPECT_NEAR(down.reflected[0], 75, 36);
    EXPECT_NEAR(down.reflected[1], 938, 36);
}

TEST(Thymio2Body, ALampIsFeltAsAmbientLight) {
    Arena arena({.width = 2, .height = 2});
    const thymio2::Body body(arena, {{1, 1}, 0});
    Ground ground(2, 2, {1, 1, 1});
    ground.set_lamps({{1.072, 1.012}});
    Noise noise(3);
    const auto down = body.look_down(arena.pose(body.id()), ground, noise);
    EXPECT_EQ(down.ambient[0], 1023);  // right above it
    EXPECT_EQ(down.ambient[1], 998);   // 2.4 cm beside it: 1023 * 0.976 = 998.4
}

// 500 is 16.6 cm/s: in 5 s 0.83 m, less the start, for which the motors take 10 ms.
TEST(Thymio2Body, FiveHundredIsSixteenPointSixCentimetresASecond) {
    Arena arena({.width = 3, .height = 2});
    thymio2::Body body(arena, {{1, 1}, 0});
    for (int i = 0; i < 500; ++i) {
        body.drive(arena, 500, 500);
        arena.step();
    }
    EXPECT_NEAR(arena.pose(body.id()).at.x, 1.83, 0.003);
    EXPECT_EQ(body.left_speed(), 500);
}

// Wheels 9.5 cm apart: 250 and -250 turn 2 * 0.083 / 0.095 = 1.747 rad/s.
TEST(Thymio2Body, TurningOnTheSpotFollowsTheWheelbase) {
    Arena arena({.width = 2, .height = 2});
    thymio2::Body body(arena, {{1, 1}, 0});
    for (int i = 0; i < 200; ++i) {
        body.drive(arena, -250, 250);
        arena.step();
    }
    EXPECT_NEAR(arena.pose(body.id()).angle, 2 * 1.747, 0.03);
    EXPECT_NEAR(arena.pose(body.id()).at.x, 1, 1e-4);
}

TEST(Thymio2Body, NoMotorIsFasterThanTwentyCentimetresASecond) {
    Arena arena({.width = 2, .height = 2});
    thymio2::Body body(arena, {{0.5, 1}, 0});
    for (int i = 0; i < 100; ++i) {
        body.drive(arena, INT16_MAX, INT16_MAX);
        arena.step();
    }
    EXPECT_EQ(body.left_speed(), 602);  // 0.2 m/s * 500 / 0.166
    EXPECT_LT(arena.pose(body.id()).at.x, 0.701);
}

TEST(Wheels, AStepIsFollowedAsAFirstOrderSystemDoes) {
    Wheels wheels({.base = 0.1, .response = 0.01, .speed_max = 1});
    wheels.step(1, 1);
    EXPECT_NEAR(wheels.left(), 1 - std::exp(-1.0), 0.005);
    wheels.step(1, 1);
    EXPECT_NEAR(wheels.left(), 1 - std::exp(-2.0), 0.005);
}

TEST(EpuckBody, SensorsReadWhatWasMeasured) {
    // Turned so that sensor 0, which looks 17 degrees to the right, looks straight at the wall.
    const Measured table[] = {{0.042, 2985}, {0.046, 1848}, {0.050, 1125}, {0.058, 493},
                              {0.066, 266},  {0.078, 134},  {0.098, 60},   {0.16, 0}};
    for (const Measured& row : table) {
        SCOPED_TRACE(row.distance);
        Arena arena({.width = 2, .height = 2});
        add_wall(arena, row.distance);
        const epuck::Body body(arena, {{1, 1}, 17 * trig::kPi / 180});
        arena.prepare_looks();
        Noise noise(1);
        // Sensor 0 is 3.7 cm ahead; noise is below 4 times 10.
        EXPECT_NEAR(body.look(arena, noise)[0], row.reading, 40 + 0.02 * row.reading);
    }
}

TEST(EpuckBody, TheCameraSeesAPostWhereItIs) {
    Arena arena({.width = 2, .height = 2});
    const epuck::Body body(arena, {{0.5, 1}, 0});
    // From the camera at 3.7 cm: 0.2 m ahead and tan 10 degrees of it to the left; 2.9 degrees wide
    // to each side.
    const BodyId post = arena.add_object({.id = "",
                                          .kind = ObjectKind::Cylinder,
                                          .at = {0.737, 1 + 0.2 * trig::tan(trig::kPi / 18)},
                                          .radius = 0.0103});
    arena.prepare_looks();
    const auto columns = body.look_ahead(arena);
    for (size_t i = 0; i < columns.size(); ++i) {
        const double degrees = static_cast<double>(i) - 29.5;
        const bool inside = std::fabs(degrees - 10) < 2.8;
        const bool outside = std::fabs(degrees - 10) > 3.1;
        if (inside) {
            EXPECT_EQ(columns[i].body, post) << i;
        }
        if (outside) {
            EXPECT_EQ(columns[i].body, kBorder) << i;
        }
    }
}

TEST(Noise, HasMeanZeroAndDeviationOne) {
    const uint64_t seed = 5;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Noise noise(seed);
    double sum = 0;
    double squares = 0;
    constexpr int kCount = 100000;
    for (int i = 0; i < kCount; ++i) {
        const double value = noise.next();
        ASSERT_LT(std::fabs(value), 3.5);
        sum += value;
        squares += value * value;
    }
    EXPECT_NEAR(sum / kCount, 0, 0.02);
    EXPECT_NEAR(squares / kCount, 1, 0.02);
}

}  // namespace
