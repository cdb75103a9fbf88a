// What a Carbot's range and head nodes perceive, without their scripts.
#include <gtest/gtest.h>

#include "base/trig.hpp"
#include "sim/carbot/head_senses.hpp"
#include "sim/carbot/sonar.hpp"
#include "sim/test_host.hpp"
#include "sim/world.hpp"

using namespace vagus;
using namespace vagus::sim;
using namespace vagus::sim::carbot;
using namespace std::chrono_literals;

namespace {

using trig::kDegree;

// A robot at (5, 5) of an open field, looking along x: its rotator is at (5.18, 5).
class Senses : public testing::Test {
protected:
    Senses()
        : arena_({.width = 10, .height = 10, .open = true}),
          body_(arena_.add_robot({{}, 0.17}, {{5, 5}, 0}, {.height = 0.22})),
          colours_(1) {}

    void add(const ObjectDefinition& object) {
        arena_.add_object(object);
        colours_.push_back(object.colour);
    }
    // A wall 2 m long whose near face goes through a point this far ahead of the rotator, its
    // normal turned by `slant` from the axis.
    void add_wall(double ahead, double slant = 0, double height = 0.3) {
        const double half = 0.05;
        add({.kind = ObjectKind::Wall,
             .at = {5.18 + ahead + half * trig::cos(slant), 5 + half * trig::sin(slant)},
             .angle = slant,
             .width = 2 * half,
             .length = 4,
             .height = height});
    }
    void add_post(Point at, double height = 0.3) {
        add({.kind = ObjectKind::Cylinder, .at = at, .radius = 0.02, .height = height});
    }

    Arena arena_;
    BodyId body_;
    std::vector<Colour> colours_;
};

// ---- the ultrasonic sensor ----

class Sounding : public Senses {
protected:
    // Milliseconds until it has happened, at most 1000.
    template <typename Happened>
    int until(const Happened& happened) {
        for (int ms = 1; ms <= 1000; ++ms) {
            now_ += 1ms;
            sonar_.step(arena_, body_, now_);
            if (happened()) return ms;
        }
        return -1;
    }
    int ping() {
        sonar_.ping();
        return until([this] { return sonar_.take_echo(); });
    }
    // The mean of many: noise of 1 % is one of 0.05 % then.
    double mean_distance() {
        double sum = 0;
        for (int i = 0; i < 400; ++i) {
            ping();
            sum += sonar_.distance();
        }
        return sum / 400;
    }

    Sonar sonar_{7};
    Time now_{};
};

TEST_F(Sounding, TellsTheDistanceOfAWallAhead) {
    add_wall(1.0);
    EXPECT_NEAR(mean_distance(), 1000, 2.5);
}

// 0.9 m there and 0.9 m back at 343 m/s are 5.25 ms, with all noise (3.5 %) between 5 and 6. The
// sound leaves in the first millisecond.
TEST_F(Sounding, TheEchoTakesAsLongAsTheSound) {
    add_wall(0.9);
    EXPECT_EQ(ping(), 1 + 6);
}

TEST_F(Sounding, NothingWithinThreeMetresIsZeroAfterTwentyMilliseconds) {
    add_wall(3.01);
    EXPECT_EQ(ping(), 1 + 20);
    EXPECT_EQ(sonar_.distance(), 0);
}

TEST_F(Sounding, WhatIsNearerThanThreeCentimetresReadsSo) {
    add_wall(0.01);
    ping();
    EXPECT_EQ(sonar_.distance(), 30);
}

// A wall through the point 1 m ahead, its normal 45 degrees off the axis. The ray at 12 degrees
// toward the normal meets it first: cos 45 / cos (45 - 12) = 0.8431.
TEST_F(Sounding, ASlantedWallIsHeardWhereTheConeMeetsItFirst) {
    add_wall(1.0, 45 * kDegree);
    EXPECT_NEAR(mean_distance(), 843.1, 2.5);
}

// 75 degrees off: even the ray at 12 degrees meets it at 63.
TEST_F(Sounding, ASlantBeyondSixtyDegreesThrowsTheSoundElsewhere) {
    add_wall(1.0, 75 * kDegree);
    ping();
    EXPECT_EQ(sonar_.distance(), 0);
}

// 10 degrees off the axis is in the cone, 16 degrees is not (the post is 1.2 degrees wide).
TEST_F(Sounding, HearsWhatIsInItsCone) {
    add_post({5.18 + trig::cos(10 * kDegree), 5 + trig::sin(10 * kDegree)});
    EXPECT_NEAR(mean_distance(), 980, 4);
}
TEST_F(Sounding, DoesNotHearWhatIsBesideItsCone) {
    add_post({5.18 + trig::cos(16 * kDegree), 5 + trig::sin(16 * kDegree)});
    ping();
    EXPECT_EQ(sonar_.distance(), 0);
}

TEST_F(Sounding, HearsOverLowThingsTheWallBehind) {
    add_wall(0.5, 0, 0.09);
    add_wall(1.0);
    EXPECT_NEAR(mean_distance(), 1000, 2.5);
}

// What swallows the sound also hides what is behind it.
TEST_F(Sounding, DoesNotHearThroughASlantedWall) {
    add_wall(0.5, 80 * kDegree);
    add_wall(1.5);
    ping();
    EXPECT_NE(sonar_.distance(), 500);
    EXPECT_TRUE(sonar_.distance() == 0 || sonar_.distance() > 1400) << sonar_.distance();
}

TEST_F(Sounding, TheRotatorTurnsThreeHundredDegreesASecond) {
    sonar_.turn(900);
    EXPECT_EQ(until([this] { return sonar_.take_reached(); }), 300);
    EXPECT_EQ(sonar_.angle(), 900);
    EXPECT_FALSE(sonar_.take_reached());
}

TEST_F(Sounding, TheRotatorStopsAtItsEnds) {
    sonar_.turn(1201);
    EXPECT_EQ(until([this] { return sonar_.take_reached(); }), 400);
    EXPECT_EQ(sonar_.angle(), 1200);
    sonar_.turn(INT16_MIN);
    EXPECT_EQ(until([this] { return sonar_.take_reached(); }), 800);
    EXPECT_EQ(sonar_.angle(), -1200);
}

TEST_F(Sounding, AnAngleThatItHasIsReachedAtOnce) {
    sonar_.turn(0);
    EXPECT_EQ(until([this] { return sonar_.take_reached(); }), 1);
}

// The wall is 1.0 m to the left of the rotator.
TEST_F(Sounding, LooksWhereTheRotatorPoints) {
    add({.kind = ObjectKind::Wall, .at = {5, 6.05}, .width = 4, .length = 0.1, .height = 0.3});
    EXPECT_FALSE(sonar_.look({{5, 5}, 0}));
    sonar_.turn(900);
    until([this] { return sonar_.take_reached(); });
    EXPECT_NEAR(mean_distance(), 1000, 2.5);
    EXPECT_EQ(sonar_.heard_angle(), 900);
    const Beam look = *sonar_.look({{5, 5}, 0});
    EXPECT_NEAR(look.to.x, 5.18, 1e-9);
    EXPECT_NEAR(look.to.y, 6, 0.04);
    EXPECT_TRUE(look.hit);
}

// ---- infrared ----

class Infrared : public Senses {
protected:
    InfraredReading look(std::vector<Point> beacons) {
        return look_for_beacon(arena_, body_, beacons, noise_);
    }
    double mean_direction(const std::vector<Point>& beacons) {
        double sum = 0;
        for (int i = 0; i < 400; ++i) sum += look(beacons).direction;
        return sum / 400;
    }
    Noise noise_{3};
};

// At (6, 6): 45 degrees to the left, 1.4142 m away: 1000 * (1 - 1.4142 / 4) = 646.4.
TEST_F(Infrared, TellsDirectionAndNearness) {
    EXPECT_NEAR(mean_direction({{6, 6}}), 450, 4);
    EXPECT_EQ(look({{6, 6}}).intensity, 646);
    EXPECT_NEAR(mean_direction({{6, 4}}), -450, 4);
}

TEST_F(Infrared, TurnsWithTheRobot) {
    arena_.place(body_, {{5, 5}, 90 * kDegree});
    EXPECT_NEAR(mean_direction({{6, 6}}), -450, 4);
}

TEST_F(Infrared, TheNearestOfSeveralIsTold) {
    EXPECT_NEAR(mean_direction({{5, 7}, {6, 5}, {2, 5}}), 0, 4);
}

TEST_F(Infrared, FourMetresAreTooFar) {
    EXPECT_EQ(look({{8.96, 5}}).intensity, 10);  // 1000 * 0.04 / 4
    EXPECT_EQ(look({{9.0, 5}}), InfraredReading{});
}

TEST_F(Infrared, AWallHidesABeaconAndALowOneDoesNot) {
    add_wall(0.5, 0, 0.09);
    EXPECT_EQ(look({{6.5, 5}}).intensity, 625);
    add_wall(0.8);
    EXPECT_EQ(look({{6.5, 5}}), InfraredReading{});
    // The next one is seen instead.
    EXPECT_EQ(look({{6.5, 5}, {3, 5}}).intensity, 500);
}

TEST_F(Infrared, ABeaconOnAPostShinesThroughIt) {
    add_post({6, 5});
    EXPECT_EQ(look({{6, 5}}).intensity, 750);
}

// ---- colour ----

class NearColour : public Senses {
protected:
    // A red box whose face is so far before the hull, which ends 0.20 m ahead.
    ColourReading before(double gap, double height = 0.2) {
        add({.kind = ObjectKind::Box,
             .at = {5.2 + gap + 0.1, 5},
             .width = 0.2,
             .length = 0.2,
             .height = height,
             .colour = {1, 0.25, 0}});
        return look_at_colour(arena_, body_, colours_);
    }
};

TEST_F(NearColour, TellsTheColourOfWhatIsClose) {
    EXPECT_EQ(before(0.14), (ColourReading{1, {1000, 250, 0}}));
}
TEST_F(NearColour, OfWhatTouchesTheHullToo) {
    EXPECT_EQ(before(-0.001), (ColourReading{1, {1000, 250, 0}}));
}
TEST_F(NearColour, NothingBeyondFifteenCentimetres) {
    EXPECT_EQ(before(0.16), ColourReading{});
}
TEST_F(NearColour, NothingOfWhatLiesLow) {
    EXPECT_EQ(before(0.1, 0.02), ColourReading{});
}

// ---- in a world ----

// Addresses of docs/carbot.md.
constexpr size_t kInfraredIntensity = 35;
constexpr size_t kColourNear = 36;
constexpr size_t kColourRgb = 37;

WorldDefinition with_carbot() {
    WorldDefinition world;
    world.width = world.height = 4;
    world.robots.push_back({.name = "carbot", .type = RobotType::Carbot, .at = {2, 2}, .node = 1});
    return world;
}

// 1 m from the beacon: 750.
TEST(CarbotInAWorld, SeesTheBeaconsThatAreOn) {
    WorldDefinition definition = with_carbot();
    definition.objects.push_back({.id = "lamp", .kind = ObjectKind::Infrared, .at = {3, 2}});
    World world = make_world(definition);
    world.step(50ms);
    EXPECT_EQ(world.variables_of(4)[kInfraredIntensity], 750);
    ASSERT_TRUE(world.switch_light(*world.find_object("lamp"), false).ok());
    world.step(50ms);
    EXPECT_EQ(world.variables_of(4)[kInfraredIntensity], 0);
}

TEST(CarbotInAWorld, SeesTheColourOfAnObject) {
    WorldDefinition definition = with_carbot();
    definition.objects.push_back(
        {.kind = ObjectKind::Cylinder, .at = {2.4, 2}, .radius = 0.1, .colour = {0, 0.5, 1}});
    World world = make_world(definition);
    world.step(50ms);
    EXPECT_EQ(world.variables_of(4)[kColourNear], 1);
    EXPECT_EQ(world.variables_of(4)[kColourRgb + 1], 500);
    EXPECT_EQ(world.variables_of(4)[kColourRgb + 2], 1000);
}

TEST(CarbotInAWorld, HasACameraAndAThymioHasNone) {
    WorldDefinition definition = with_carbot();
    definition.robots.push_back({.name = "thymio", .at = {1, 1}, .node = 9});
    const World world = make_world(definition);
    const Result<Picture> picture = world.render(*world.find_robot("carbot"));
    ASSERT_TRUE(picture.ok());
    EXPECT_EQ(picture.value().width, 160u);
    const Result<Picture> none = world.render(*world.find_robot("thymio"));
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().what, "thymio has no camera; a carbot has one");
}

TEST(CarbotInAWorld, ItsNodesShareACanBus) {
    const World world = make_world(with_carbot());
    const BusLoad load = *world.bus_load();
    ASSERT_EQ(load.nodes.size(), 5u);
    EXPECT_EQ(load.nodes[0].load.name, "main");
    EXPECT_EQ(load.nodes[1].load.name, "drive");
    EXPECT_EQ(load.nodes[4].load.name, "head");
    EXPECT_EQ(load.nodes[4].node, 4);
}

}  // namespace
