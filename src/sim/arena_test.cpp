#include "sim/arena.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/rng.hpp"
#include "base/trig.hpp"

using namespace vagus;
using namespace vagus::sim;

namespace {

constexpr std::array<Point, 4> kSquare = {
    {{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}, {-0.05, 0.05}}};
constexpr RobotBody kBody = {.mass = 0.3, .inertia = 5e-4, .grip = 0.05, .height = 0.05};

BodyId add_square(Arena& arena, const Pose& pose) {
    return arena.add_robot({.corners = kSquare, .radius = 0}, pose, kBody);
}

void run(Arena& arena, double seconds) {
    const auto steps = static_cast<int>(std::lround(seconds / kArenaStep));
    for (int i = 0; i < steps; ++i) arena.step();
}

// How far a single ray of `robot` gets.
double look(Arena& arena, BodyId robot, const Ray& ray, double eye = 0.03) {
    arena.prepare_looks();
    const std::array<Ray, 1> rays = {ray};
    std::array<double, 1> distance{};
    arena.look(robot, RayFan(rays), eye, distance);
    return distance[0];
}

constexpr Ray kAhead = {{0.05, 0}, {1, 0}, 0.5};

TEST(Arena, AStraightDriveIsSpeedTimesTime) {
    Arena arena({.width = 2, .height = 2});
    const BodyId robot = add_square(arena, {{0.5, 1}, 0});
    arena.drive(robot, {.forward = 0.1, .turn = 0});
    run(arena, 5);
    // 0.1 m/s for 5 s, less what the tyres need for the start: the first step gives 0.0981 m/s.
    EXPECT_NEAR(arena.pose(robot).at.x, 1.0, 1e-4);
    EXPECT_NEAR(arena.pose(robot).at.y, 1.0, 1e-6);
}

// Box2D moves who is beside something, and the arena itself who is alone: nobody may see which.
TEST(Arena, ARobotGoesTheSameWayAloneAndBesideAWallToTheLastBit) {
    Arena wide({.width = 3, .height = 3});
    Arena narrow({.width = 3, .height = 3});
    (void)narrow.add_object({.at = {1, 1.13}, .width = 0.5, .length = 0.1});
    const BodyId alone = add_square(wide, {{1, 1}, 0.3});
    const BodyId beside = add_square(narrow, {{1, 1}, 0.3});
    for (int i = 0; i < 3000; ++i) {
        // The corner comes to 9 mm from the wall. A tiny round, the other way for a while, then a
        // rest, or a turn so slow that Box2D puts the body to sleep over it.
        const bool slow = i % 1000 >= 500;
        const Drive round = {.forward = 0.001, .turn = slow ? -1.1 : 1.5};
        const Drive drive = i % 500 < 400 ? round : Drive{.turn = slow ? 0.02 : 0};
        wide.drive(alone, drive);
        narrow.drive(beside, drive);
        wide.step();
        narrow.step();
        ASSERT_EQ(wide.pose(alone), narrow.pose(beside)) << "step " << i;
        ASSERT_TRUE(narrow.touches().empty());
    }
}

TEST(Arena, AFullCircleEndsWhereItBegan) {
    Arena arena({.width = 2, .height = 2});
    const BodyId robot = add_square(arena, {{1, 1}, 0.3});
    // 10 s for 2 pi; the circle has a radius of 0.2 / (2 pi / 10) / 2 = 0.159 m.
    arena.drive(robot, {.forward = 0.1, .turn = 2 * trig::kPi / 10});
    double farthest = 0;
    for (int i = 0; i < 1000; ++i) {
        arena.step();
        const Point at = arena.pose(robot).at;
        farthest = std::max(farthest, trig::hypot(at.x - 1, at.y - 1));
    }
    EXPECT_NEAR(farthest, 2 * 0.1 / (2 * trig::kPi / 10), 1e-3);
    EXPECT_NEAR(arena.pose(robot).at.x, 1, 1e-3);
    EXPECT_NEAR(arena.pose(robot).at.y, 1, 1e-3);
    EXPECT_NEAR(arena.pose(robot).angle, 0.3 + 2 * trig::kPi, 1e-3);
}

TEST(Arena, AnAngleDoesNotGrowForEver) {
    Arena arena({.width = 1, .height = 1});
    const BodyId robot = add_square(arena, {{0.5, 0.5}, 0});
    arena.drive(robot, {.forward = 0, .turn = 10});
    run(arena, 60);  // 600 rad
    const double angle = arena.pose(robot).angle;
    EXPECT_LT(std::fabs(angle), 8.2);
    // The tyres give at most 0.3 * 9.81 * 0.05 / 5e-4 * 0.01 = 2.943 rad/s more in a step: the
    // first three steps are 7.057, 4.114 and 1.171 rad/s too slow.
    const double turns = (600 - 0.12342 - angle) / (2 * trig::kPi);
    EXPECT_NEAR(turns, std::round(turns), 0.001);
}

TEST(Arena, NothingPassesThroughAWallOfAMillimetre) {
    Arena arena({.width = 2, .height = 1});
    arena.add_object(
        {.id = "", .kind = ObjectKind::Wall, .at = {1, 0.5}, .width = kObjectSizeMin, .length = 1});
    const BodyId robot = add_square(arena, {{0.5, 0.5}, 0});
    arena.drive(robot, {.forward = 0.2, .turn = 0});
    run(arena, 20);
    // Its front is 0.05 m ahead; bodies are a skin of a millimetre apart.
    EXPECT_NEAR(arena.pose(robot).at.x, 0.95, 0.003);
}

TEST(Arena, TheBorderHoldsRobotsAndAnOpenWorldDoesNot) {
    for (const bool open : {false, true}) {
        Arena arena({.width = 1, .height = 1, .open = open});
        const BodyId robot = add_square(arena, {{0.5, 0.5}, trig::kPi / 2});
        arena.drive(robot, {.forward = 0.2, .turn = 0});
        run(arena, 10);
        if (open)
            EXPECT_GT(arena.pose(robot).at.y, 2.4);
        else
            EXPECT_NEAR(arena.pose(robot).at.y, 0.95, 0.003);
    }
}

TEST(Arena, ALightBoxIsPushedAndAHeavyOneHoldsTheRobot) {
    for (const double mass : {0.1, 50.0}) {
        Arena arena({.width = 2, .height = 1});
        const BodyId box = arena.add_object({.id = "",
                                             .kind = ObjectKind::Box,
                                             .at = {0.8, 0.5},
                                             .width = 0.1,
                                             .length = 0.2,
                                             .mass = mass});
        const BodyId robot = add_square(arena, {{0.5, 0.5}, 0});
        arena.drive(robot, {.forward = 0.1, .turn = 0});
        run(arena, 5);
        const double moved = arena.pose(box).at.x - 0.8;
        if (mass < 1)
            EXPECT_GT(moved, 0.1);
        else
            EXPECT_LT(moved, 0.01);
        arena.drive(robot, {});
        run(arena, 1);
        const double rested = arena.pose(box).at.x;
        run(arena, 1);
        EXPECT_NEAR(arena.pose(box).at.x, rested, 1e-6) << "the ground stops what slides";
    }
}

TEST(Arena, TouchesAreToldOnceWithBothPartners) {
    Arena arena({.width = 2, .height = 1});
    const BodyId wall = arena.add_object(
        {.id = "", .kind = ObjectKind::Wall, .at = {1, 0.5}, .width = 0.1, .length = 0.5});
    const BodyId robot = add_square(arena, {{0.8, 0.5}, 0});
    arena.drive(robot, {.forward = 0.1, .turn = 0});
    int touches = 0;
    for (int i = 0; i < 300; ++i) {
        arena.step();
        for (const Touch& touch : arena.touches()) {
            ++touches;
            EXPECT_EQ(touch.a, wall);
            EXPECT_EQ(touch.b, robot);
        }
    }
    EXPECT_EQ(touches, 1);
}

TEST(Arena, ARayEndsOnTheNearestThing) {
    Arena arena({.width = 2, .height = 2});
    const BodyId robot = add_square(arena, {{0.5, 1}, 0});
    EXPECT_EQ(look(arena, robot, kAhead), 0.5);  // nothing within its range
    arena.add_object({.id = "", .kind = ObjectKind::Cylinder, .at = {0.9, 1}, .radius = 0.1});
    EXPECT_NEAR(look(arena, robot, kAhead), 0.9 - 0.1 - 0.55, 1e-7);
    // A box turned by 45 degrees shows its corner: half of the diagonal of 0.1 is 0.0707107.
    arena.add_object({.id = "",
                      .kind = ObjectKind::Box,
                      .at = {0.75, 1},
                      .angle = trig::kPi / 4,
                      .width = 0.1,
                      .length = 0.1});
    EXPECT_NEAR(look(arena, robot, kAhead), 0.75 - 0.0707107 - 0.55, 1e-6);
    add_square(arena, {{0.68, 1}, 0});
    EXPECT_NEAR(look(arena, robot, kAhead), 0.68 - 0.05 - 0.55, 1e-6);
    EXPECT_EQ(look(arena, robot, {{-0.05, 0}, {-1, 0}, 0.2}), 0.2);
}

TEST(Arena, ARayBesideADiscMissesIt) {
    Arena arena({.width = 2, .height = 2});
    const BodyId robot = add_square(arena, {{0.5, 1}, 0});
    arena.add_object({.id = "", .kind = ObjectKind::Cylinder, .at = {0.8, 1.101}, .radius = 0.1});
    EXPECT_EQ(look(arena, robot, kAhead), 0.5);
    // 0.06 beside the middle of the disc: it is met at sqrt(0.1^2 - 0.06^2) = 0.08 before it.
    EXPECT_NEAR(look(arena, robot, {{0.05, 0.041}, {1, 0}, 0.5}), 0.25 - 0.08, 1e-7);
}

TEST(Arena, ASlantedRayMeetsTheBorder) {
    Arena arena({.width = 2, .height = 1});
    const BodyId robot = add_square(arena, {{0.5, 0.9}, 0});
    // 0.6 ahead and 0.8 to the left in each metre: 0.1 m to the left are 0.125 m of the ray.
    EXPECT_NEAR(look(arena, robot, {{0, 0}, {0.6, 0.8}, 0.5}), 0.125, 1e-7);
    EXPECT_EQ(look(arena, robot, {{0, 0}, {0.6, -0.8}, 0.5}), 0.5);
    Arena open({.width = 2, .height = 1, .open = true});
    const BodyId free = add_square(open, {{0.5, 0.9}, 0});
    EXPECT_EQ(look(open, free, {{0, 0}, {0.6, 0.8}, 0.5}), 0.5);
}

TEST(Arena, WhatIsLowerThanTheEyeIsNotSeen) {
    Arena arena({.width = 2, .height = 2});
    const BodyId robot = add_square(arena, {{0.5, 1}, 0});
    arena.add_object({.id = "",
                      .kind = ObjectKind::Wall,
                      .at = {0.8, 1},
                      .width = 0.1,
                      .length = 0.5,
                      .height = 0.03});
    EXPECT_EQ(look(arena, robot, kAhead, 0.031), 0.5);
    EXPECT_NEAR(look(arena, robot, kAhead, 0.03), 0.2, 1e-7);
}

TEST(Arena, WhatIsRemovedOrMovedIsSeenWhereItIs) {
    Arena arena({.width = 2, .height = 2});
    const BodyId robot = add_square(arena, {{0.5, 1}, 0});
    const BodyId wall = arena.add_object(
        {.id = "", .kind = ObjectKind::Wall, .at = {0.8, 1}, .width = 0.1, .length = 0.5});
    arena.place(wall, {{0.9, 1}, 0});
    EXPECT_NEAR(look(arena, robot, kAhead), 0.3, 1e-7);
    arena.place(robot, {{0.6, 1}, 0});
    EXPECT_NEAR(look(arena, robot, kAhead), 0.2, 1e-7);
    arena.remove(wall);
    EXPECT_EQ(look(arena, robot, kAhead), 0.5);
    // The next body takes the place of the removed one, with a shape of its own.
    arena.add_object({.id = "", .kind = ObjectKind::Cylinder, .at = {0.9, 1}, .radius = 0.05});
    EXPECT_NEAR(look(arena, robot, kAhead), 0.2, 1e-7);
}

TEST(Arena, AWideLookFindsTheNearestBodyInEachColumn) {
    Arena arena({.width = 4, .height = 4});
    const BodyId robot = add_square(arena, {{1, 2}, 0});
    const BodyId post =
        arena.add_object({.id = "", .kind = ObjectKind::Cylinder, .at = {2, 2}, .radius = 0.1});
    const BodyId wall = arena.add_object(
        {.id = "", .kind = ObjectKind::Wall, .at = {3, 2.5}, .width = 0.2, .length = 1});
    arena.prepare_looks();
    const std::array<double, 3> tangents = {-0.5, 0, 0.25};
    std::array<Column, 3> columns;
    arena.look_wide(robot, 0, tangents, columns);
    EXPECT_EQ(columns[0].body, kBorder);
    EXPECT_EQ(columns[1].body, post);
    EXPECT_NEAR(columns[1].distance, 0.9, 1e-7);
    EXPECT_EQ(columns[2].body, wall);  // 1.9 ahead, 0.475 to the left
    EXPECT_NEAR(columns[2].distance, 1.9 * std::sqrt(1 + 0.0625), 1e-6);
}

// The same bodies twice; in the second arena every question covers the whole grid.
TEST(Arena, TheGridChangesNothing) {
    const uint64_t seed = 20240917;
    SCOPED_TRACE("seed " + std::to_string(seed));
    SplitMix64 random(seed);
    Arena fine({.width = 3, .height = 3});
    Arena coarse({.width = 3, .height = 3});
    Arena* const both[] = {&fine, &coarse};
    std::vector<BodyId> robots;
    for (int i = 0; i < 60; ++i) {
        const Pose pose = {{random.unit() * 3, random.unit() * 3}, random.unit() * 6};
        for (Arena* arena : both) {
            const BodyId id = i % 3 == 0   ? add_square(*arena, pose)
                              : i % 3 == 1 ? arena->add_object({.id = "",
                                                                .kind = ObjectKind::Box,
                                                                .at = pose.at,
                                                                .angle = pose.angle,
                                                                .width = 0.4,
                                                                .length = 0.03})
                                           : arena->add_object({.id = "",
                                                                .kind = ObjectKind::Cylinder,
                                                                .at = pose.at,
                                                                .radius = 0.04,
                                                                .mass = 0.1});
            if (i % 3 == 0 && arena == &fine) robots.push_back(id);
        }
    }
    // One huge body that moves, far away, makes questions wide.
    coarse.add_object(
        {.id = "", .kind = ObjectKind::Cylinder, .at = {-60, -60}, .radius = 50, .mass = 1});
    std::vector<Ray> rays;
    for (int i = 0; i < 20; ++i) {
        const double angle = random.unit() * 6.28;
        rays.push_back({{0.05, 0}, {trig::cos(angle), trig::sin(angle)}, 0.1 + random.unit()});
    }
    fine.prepare_looks();
    coarse.prepare_looks();
    for (const BodyId robot : robots) {
        std::array<double, 20> a{};
        std::array<double, 20> b{};
        fine.look(robot, RayFan(rays), 0.01, a);
        coarse.look(robot, RayFan(rays), 0.01, b);
        EXPECT_EQ(a, b);
    }
}

}  // namespace
