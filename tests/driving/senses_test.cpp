// The scripts of Carbot's range and head nodes, as docs/carbot.md promises them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "pilot.hpp"

using namespace vagus;
using namespace std::chrono_literals;

namespace {

constexpr const char* kScript = "carbot/carbot.aesl";
using Words = std::vector<int16_t>;

// At (1, 2) in a room of 7 x 4 m, looking along x: the rotator stands at (1.18, 2), 2 m from the
// walls beside it and too far from the one ahead.
sim::WorldDefinition room() {
    sim::WorldDefinition world;
    world.width = 7;
    world.height = 4;
    world.robots.push_back({.name = "carbot", .type = sim::RobotType::Carbot, .at = {1, 2}});
    return world;
}
// The same with a wall across, so far ahead of the rotator.
sim::WorldDefinition room_with_wall(double ahead) {
    sim::WorldDefinition world = room();
    world.objects.push_back(
        {.id = "wall", .at = {1.18 + ahead + 0.05, 2}, .width = 0.1, .length = 1, .height = 0.5});
    return world;
}

// Noise is 1 % and never beyond 3.5 times that.
void expect_distance(int found, double wanted) {
    EXPECT_NEAR(found, wanted, 0.036 * wanted);
}

// All range.measured of a token until its range.done, without the token.
std::vector<Words> scan(Pilot& pilot, const Words& arguments) {
    pilot.send("range.scan", arguments);
    std::vector<Words> all;
    for (;;) {
        if (pilot.count("range.done", {arguments[0]}) > 0) return all;
        const auto next = pilot.next("range.measured", 2s);
        if (!next) return all;
        EXPECT_EQ((*next)[0], arguments[0]);
        all.push_back({(*next)[1], (*next)[2]});
        pilot.step(2ms);  // range.done follows at once
    }
}

std::vector<int> angles(const std::vector<Words>& measured) {
    std::vector<int> all;
    for (const Words& each : measured) all.push_back(each[0]);
    return all;
}

// ---- looks and scans ----

TEST(Range, ALookTellsTheDistanceInItsDirection) {
    Pilot pilot(room_with_wall(1.5), kScript);
    pilot.send("range.look", {5, 0});
    const auto ahead = pilot.next("range.measured", 100ms);
    ASSERT_TRUE(ahead);
    EXPECT_EQ((*ahead)[0], 5);
    EXPECT_EQ((*ahead)[1], 0);
    expect_distance((*ahead)[2], 1500);
    pilot.send("range.look", {6, 900});
    const auto left = pilot.next("range.measured", 500ms);
    ASSERT_TRUE(left);
    EXPECT_EQ((*left)[1], 900);
    expect_distance((*left)[2], 2000);
}

TEST(Range, WhereNothingIsALookTellsZero) {
    Pilot pilot(room(), kScript);
    pilot.send("range.look", {5, 0});
    EXPECT_TRUE(pilot.wait_for("range.measured", {5, 0, 0}, 100ms));
}

TEST(Range, LooksAreAnsweredInTheirOrder) {
    Pilot pilot(room(), kScript);
    pilot.send("range.look", {5, 100});
    pilot.send("range.look", {6, -100});
    pilot.send("range.look", {7, 200});
    EXPECT_EQ(pilot.next("range.measured", 1s)->front(), 5);
    EXPECT_EQ(pilot.next("range.measured", 1s)->front(), 6);
    EXPECT_EQ(pilot.next("range.measured", 1s)->front(), 7);
}

TEST(Range, AFifthLookTakesThePlaceOfTheOldest) {
    Pilot pilot(room(), kScript);
    for (int16_t token = 1; token <= 5; ++token) pilot.send("range.look", {token, 0});
    pilot.step(3s);
    EXPECT_EQ(pilot.count("range.measured"), 4u);
    EXPECT_EQ(pilot.count("range.measured", {1, 0, 0}), 0u);
    EXPECT_EQ(pilot.count("range.measured", {5, 0, 0}), 1u);
}

TEST(Range, AScanTellsEachDirectionAndItsEnd) {
    Pilot pilot(room(), kScript);
    EXPECT_EQ(angles(scan(pilot, {5, -400, 400, 200})), (std::vector{-400, -200, 0, 200, 400}));
    EXPECT_EQ(pilot.count("range.done", {5}), 1u);
}

TEST(Range, AScanMayGoToTheRight) {
    Pilot pilot(room(), kScript);
    EXPECT_EQ(angles(scan(pilot, {5, 100, -150, 100})), (std::vector{100, 0, -100}));
}

TEST(Range, AScanIsKeptWithinWhatTheRotatorCan) {
    Pilot pilot(room(), kScript);
    EXPECT_EQ(angles(scan(pilot, {5, -1800, 1800, 600})), (std::vector{-1200, -600, 0, 600, 1200}));
    EXPECT_EQ(angles(scan(pilot, {6, 0, 1, 0})), (std::vector{0, 1}));
    EXPECT_EQ(angles(scan(pilot, {7, 1200, 1200, 32767})), (std::vector{1200}));
    EXPECT_EQ(angles(scan(pilot, {8, 1100, 1200, -32768})).front(), 1100);
}

TEST(Range, UnwatchEndsAScan) {
    Pilot pilot(room(), kScript);
    pilot.send("range.scan", {5, -1200, 1200, 10});
    ASSERT_TRUE(pilot.next("range.measured", 1s));
    pilot.send("range.unwatch", {5});
    pilot.step(50ms);
    const size_t told = pilot.count("range.measured");
    pilot.step(1s);
    EXPECT_EQ(pilot.count("range.measured"), told);
    EXPECT_EQ(pilot.count("range.done"), 0u);
    pilot.send("range.look", {6, 0});
    EXPECT_TRUE(pilot.wait_for("range.measured", {6, 0, 0}, 1s));
}

// ---- watching the lane ----

// 0.4 m ahead; the sweep begins within 25 degrees of ahead.
TEST(Range, AWatcherHearsOfWhatIsNearInItsLane) {
    Pilot pilot(room_with_wall(0.4), kScript);
    pilot.send("range.watch", {9, 500, 100, 100, 250});
    const auto near = pilot.next("range.near", 300ms);
    ASSERT_TRUE(near);
    EXPECT_EQ((*near)[0], 9);
    EXPECT_LE(std::abs((*near)[1]), 250);
    expect_distance((*near)[2], 410);  // 0.4 m, or up to 0.42 at a slant
}

TEST(Range, AWatcherHearsNothingOfWhatIsFartherThanItsDistance) {
    Pilot pilot(room_with_wall(0.4), kScript);
    pilot.send("range.watch", {9, 350, 100, 100, 250});
    pilot.step(2s);
    EXPECT_EQ(pilot.count("range.near"), 0u);
}

// A post 0.3 m ahead and 0.5 m to the left is beside a lane of 17.5 + 10 cm to each side, and in
// one of 17.5 + 40 cm.
TEST(Range, AWatcherHearsNothingOfWhatIsBesideItsLane) {
    sim::WorldDefinition world = room();
    world.objects.push_back(
        {.kind = sim::ObjectKind::Cylinder, .at = {1.48, 2.5}, .radius = 0.03, .height = 0.5});
    Pilot pilot(world, kScript);
    pilot.send("range.watch", {9, 500, 100, 100, 600});
    pilot.step(3s);
    EXPECT_EQ(pilot.count("range.near"), 0u);
    pilot.send("range.watch", {9, 500, 400, 100, 600});
    const auto near = pilot.next("range.near", 3s);
    ASSERT_TRUE(near);
    EXPECT_GT((*near)[1], 450);
}

TEST(Range, WhoUnwatchesHearsNoMoreAndOthersDo) {
    Pilot pilot(room_with_wall(0.4), kScript);
    pilot.send("range.watch", {9, 500, 100, 100, 250});
    pilot.send("range.watch", {10, 600, 50, 100, 200});
    pilot.step(1s);
    const auto tokens = [&pilot](int16_t token, Duration span) {
        size_t count = 0;
        for (const Time end = pilot.now() + span; pilot.now() < end;) {
            const auto near = pilot.next("range.near", 100ms);
            if (near && near->front() == token) ++count;
        }
        return count;
    };
    pilot.send("range.unwatch", {9});
    pilot.step(10ms);
    EXPECT_EQ(tokens(9, 1s), 0u);
    EXPECT_GT(tokens(10, 1s), 5u);
}

// Of something right ahead, 0.4 m away.
bool heard_ahead(const Pilot& pilot, int16_t token) {
    for (int16_t distance = 380; distance <= 420; ++distance)
        if (pilot.count("range.near", {token, 0, distance}) > 0) return true;
    return false;
}

TEST(Range, AFifthWatcherTakesThePlaceOfTheOldest) {
    Pilot pilot(room_with_wall(0.4), kScript);
    for (int16_t token = 1; token <= 5; ++token)
        pilot.send("range.watch", {token, 500, 100, 100, 0});
    pilot.step(500ms);
    pilot.step(500ms);
    EXPECT_TRUE(heard_ahead(pilot, 2));
    EXPECT_TRUE(heard_ahead(pilot, 5));
    // The first was in the list for the first measurements at most.
    const size_t all = pilot.count("range.near");
    EXPECT_GT(all, 40u);
    EXPECT_FALSE(heard_ahead(pilot, 1));
}

// Both get their turn.
TEST(Range, LooksAreAnsweredWhileSomeoneWatches) {
    Pilot pilot(room_with_wall(0.4), kScript);
    pilot.send("range.watch", {9, 500, 100, 100, 250});
    for (int16_t token = 20; token < 25; ++token) {
        pilot.send("range.look", {token, 900});
        const auto measured = pilot.next("range.measured", 1s);
        ASSERT_TRUE(measured) << token;
        EXPECT_EQ(measured->front(), token);
        EXPECT_TRUE(pilot.next("range.near", 1s));
    }
}

// A scan is not torn apart by the sweep: five directions 20 degrees apart take below a second.
TEST(Range, AScanIsNotInterruptedBySweeps) {
    Pilot pilot(room(), kScript);
    pilot.send("range.watch", {9, 500, 100, 100, 1200});
    pilot.step(300ms);
    pilot.send("range.scan", {5, -400, 400, 200});
    EXPECT_TRUE(pilot.wait_for("range.done", {5}, 1500ms));
    EXPECT_EQ(pilot.count("range.measured"), 5u);
}

// ---- guarding a distance ----

// The face of a long wall lies 0.6 m to the left of the rotator, and nothing else within 2 m. Heard
// at 90 degrees it is 600 mm away, at most 3.6 % less by noise; no direction hears it nearer.
sim::WorldDefinition room_with_wall_beside() {
    sim::WorldDefinition world = room();
    world.objects.push_back({.at = {1.18, 2.65}, .width = 4, .length = 0.1, .height = 0.5});
    return world;
}

TEST(Range, AGuardComparesTheDistanceItself) {
    Pilot pilot(room_with_wall_beside(), kScript);
    pilot.send("range.guard", {9, 500, 200, 900});
    pilot.step(5s);
    EXPECT_EQ(pilot.count("range.near"), 0u);
    pilot.send("range.guard", {9, 700, 200, 900});
    const auto near = pilot.next("range.near", 3s);
    ASSERT_TRUE(near);
    EXPECT_EQ((*near)[0], 9);
    EXPECT_GT((*near)[1], 0);    // to the left
    EXPECT_GE((*near)[2], 578);  // 600 - 3.6 %
    EXPECT_LT((*near)[2], 700);
}

// The sweep goes as far as the second one wants; the wall is not in sight of the first: its nearest
// spot within 12 degrees of 40 (30 and half a step) is 600 / sin 52 = 761 mm away.
TEST(Range, AGuardHearsNothingOfWhatIsBesideItsSpread) {
    Pilot pilot(room_with_wall_beside(), kScript);
    pilot.send("range.guard", {9, 700, 200, 300});
    pilot.send("range.guard", {10, 700, 200, 900});
    for (int heard = 0; heard < 10; ++heard) {
        const auto near = pilot.next("range.near", 3s);
        ASSERT_TRUE(near);
        EXPECT_EQ(near->front(), 10);
    }
}

// Of a wall beside that lane: 600 mm to the left is more than 175 + 100.
TEST(Range, WhoWatchesTheLaneAndWhoGuardsHearEachItsOwn) {
    Pilot pilot(room_with_wall_beside(), kScript);
    pilot.send("range.watch", {9, 700, 100, 200, 900});
    pilot.send("range.guard", {10, 700, 200, 900});
    const auto near = pilot.next("range.near", 3s);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->front(), 10);
    pilot.send("range.unwatch", {10});
    pilot.step(10ms);
    const size_t all = pilot.count("range.near");
    pilot.step(3s);
    EXPECT_EQ(pilot.count("range.near"), all);
}

TEST(Range, AFifthGuardTakesThePlaceOfTheOldest) {
    Pilot pilot(room_with_wall(0.4), kScript);
    for (int16_t token = 1; token <= 5; ++token) pilot.send("range.guard", {token, 500, 200, 0});
    pilot.step(1s);
    EXPECT_FALSE(heard_ahead(pilot, 1));
    for (int16_t token = 2; token <= 5; ++token) EXPECT_TRUE(heard_ahead(pilot, token)) << token;
}

// ---- infrared ----

sim::WorldDefinition room_with_beacon() {
    sim::WorldDefinition world = room();
    world.objects.push_back({.id = "beacon", .kind = sim::ObjectKind::Infrared, .at = {2, 3}});
    return world;
}

// 1.4142 m away, 45 degrees to the left: 1000 * (1 - 1.4142 / 4) = 646. Noise: 2 degrees, at most
// 3.5 times that.
TEST(Head, TellsWhereTheBeaconIs) {
    Pilot pilot(room_with_beacon(), kScript);
    pilot.step(100ms);
    pilot.send("infrared.ask", {5});
    const auto told = pilot.next("infrared.told", 100ms);
    ASSERT_TRUE(told);
    EXPECT_EQ((*told)[0], 5);
    EXPECT_NEAR((*told)[1], 450, 70);
    EXPECT_EQ((*told)[2], 646);
}

TEST(Head, AWatcherHearsOnceOfABeaconAndAgainWhenItComesAnew) {
    Pilot pilot(room_with_beacon(), kScript);
    const sim::ObjectId beacon = *pilot.world().find_object("beacon");
    pilot.send("infrared.watch", {5, 1});
    EXPECT_TRUE(pilot.next("infrared.found", 200ms));
    EXPECT_FALSE(pilot.next("infrared.found", 500ms));
    ASSERT_TRUE(pilot.world().switch_light(beacon, false).ok());
    pilot.step(200ms);
    ASSERT_TRUE(pilot.world().switch_light(beacon, true).ok());
    EXPECT_TRUE(pilot.next("infrared.found", 200ms));
    pilot.send("infrared.watch", {6, 1});  // hears of what is there already
    EXPECT_EQ(pilot.next("infrared.found", 200ms)->front(), 6);
    pilot.send("infrared.unwatch", {6});
    pilot.step(10ms);
    ASSERT_TRUE(pilot.world().switch_light(beacon, false).ok());
    pilot.step(200ms);
    ASSERT_TRUE(pilot.world().switch_light(beacon, true).ok());
    EXPECT_EQ(pilot.next("infrared.found", 200ms)->front(), 5);
    EXPECT_FALSE(pilot.next("infrared.found", 200ms));
}

// The beacon's intensity is 646 (see above).
TEST(Head, AWatcherHearsOnlyOfWhatIsBrightEnough) {
    Pilot pilot(room_with_beacon(), kScript);
    pilot.send("infrared.watch", {5, 647});
    pilot.send("infrared.watch", {6, 646});
    const auto found = pilot.next("infrared.found", 300ms);
    ASSERT_TRUE(found);
    EXPECT_EQ((*found)[0], 6);
    EXPECT_EQ((*found)[2], 646);
    pilot.step(500ms);
    EXPECT_EQ(pilot.count("infrared.found"), 1u);
    pilot.send("infrared.unwatch", {5});  // the second one moves up, with what it wants
    pilot.step(200ms);
    EXPECT_EQ(pilot.count("infrared.found"), 1u);
}

// Less than 1 and more than 1000 are taken as the nearest: nothing is no beacon.
TEST(Head, TheLeastIntensityIsKeptWithinItsRange) {
    Pilot pilot(room(), kScript);
    pilot.send("infrared.watch", {5, 0});
    pilot.send("infrared.watch", {6, 1001});
    pilot.step(200ms);
    EXPECT_EQ(pilot.count("infrared.found"), 0u);
    ASSERT_TRUE(pilot.world().add({.kind = sim::ObjectKind::Infrared, .at = {1, 2}}).ok());
    pilot.step(200ms);
    EXPECT_EQ(pilot.count("infrared.found"), 2u);  // both: it is as bright as can be
}

TEST(Head, AFifthWatcherTakesThePlaceOfTheOldest) {
    Pilot pilot(room(), kScript);
    for (int16_t token = 1; token <= 5; ++token) pilot.send("infrared.watch", {token, 1});
    pilot.step(100ms);
    ASSERT_TRUE(pilot.world().add({.kind = sim::ObjectKind::Infrared, .at = {2, 2}}).ok());
    pilot.step(200ms);
    EXPECT_EQ(pilot.count("infrared.found"), 4u);
    for (int16_t token = 1; token <= 5; ++token) pilot.send("colour.watch", {token});
    pilot.step(100ms);
    ASSERT_TRUE(
        pilot.world().add({.kind = sim::ObjectKind::Cylinder, .at = {1.4, 2}, .radius = 0.1}).ok());
    pilot.step(200ms);
    EXPECT_EQ(pilot.count("colour.found"), 4u);
}

// ---- colour ----

// 10 cm before the hull, which ends at 1.2 m.
TEST(Head, TellsTheColourAheadToThoseWhoAskAndToThoseWhoWatch) {
    Pilot pilot(room(), kScript);
    pilot.send("colour.watch", {5});
    pilot.step(100ms);
    pilot.send("colour.ask", {6});
    EXPECT_TRUE(pilot.wait_for("colour.told", {6, 0, 0, 0, 0}, 100ms));
    ASSERT_TRUE(pilot.world()
                    .add({.kind = sim::ObjectKind::Cylinder,
                          .at = {1.4, 2},
                          .radius = 0.1,
                          .colour = {0.9, 0.2, 0}})
                    .ok());
    EXPECT_TRUE(pilot.wait_for("colour.found", {5, 900, 200, 0}, 100ms));
    EXPECT_EQ(pilot.count("colour.found"), 1u);
    pilot.send("colour.ask", {7});
    EXPECT_TRUE(pilot.wait_for("colour.told", {7, 1, 900, 200, 0}, 100ms));
    pilot.send("colour.unwatch", {5});
    pilot.step(200ms);
    EXPECT_EQ(pilot.count("colour.found"), 1u);
}

// ---- light ----

TEST(Head, ShowsTheLightThatItIsTold) {
    Pilot pilot(room(), kScript);
    const auto light = [&pilot] { return pilot.world().lamps({1}).front().colour; };
    EXPECT_EQ(light(), (sim::Colour{0, 0, 0}));
    pilot.send("head.light", {32, 16, -5});
    pilot.step(5ms);
    EXPECT_EQ(light(), (sim::Colour{1, 0.5, 0}));
}

}  // namespace
