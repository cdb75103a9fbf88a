// examples/infrared: where Carbot ends, from the beacon.
#include <gmock/gmock.h>

#include "trial.hpp"

namespace vagus::samples {
namespace {

// The plan ends where the beacon is bright as at half a metre, and slows down before.
constexpr double kNearMetres = 0.6;

void drive_to_beacon(const std::string& world, const sim::Point& beacon) {
    Worst off("from the beacon, m"), contact("longest contact of the hull, s"), took("time, s");
    const TrialOptions options{.plan = example("infrared/DriveToBeacon.plan.json"),
                               .world = world,
                               .off_metres = 0.2,
                               .off_radians = 0.5};
    try_seeds(options, [&](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok);
        const double gap = metres_between(trial.ran.way.back().pose.at, beacon);
        EXPECT_LT(off.note(gap), kNearMetres);
        EXPECT_LE(contact.note(seconds(trial.longest_contact())), 2);
        took.note(seconds(trial.ran.way.back().at));
    });
}

TEST(Infrared, CarbotFindsTheBeaconBehindAWall) {
    drive_to_beacon(example("infrared/room.world.json"), {5.2, 3});
}

TEST(Infrared, CarbotGoesAroundAWallThatHidesTheBeacon) {
    drive_to_beacon(test_world("barrier.world.json"), {4.6, 2});
}

TEST(Infrared, CarbotComesOutOfAPocketBeforeTheBeacon) {
    drive_to_beacon(test_world("pocket.world.json"), {5.5, 3.2});
}

// The world for which the plan was not made.
TEST(Infrared, CarbotFindsTheBeaconInAStoreroom) {
    drive_to_beacon(test_world("storeroom.world.json"), {1, 4.2});
}

}  // namespace
}  // namespace vagus::samples
