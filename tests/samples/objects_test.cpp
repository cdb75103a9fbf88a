// examples/find-object and examples/follow-object: what Carbot does by its camera.
#include <gmock/gmock.h>

#include <algorithm>

#include "trial.hpp"

namespace vagus::samples {
namespace {

using testing::Contains;

constexpr double kFront = 0.2;  // of the hull, from its middle (docs/carbot.md)

struct Bin {
    std::string world;
    sim::Point at;
    double radius;
    std::vector<std::pair<std::string, plan::Value>> colour;  // variables of the plan
};

// It stops 10 cm before the bin by the distance that it has measured.
constexpr double kNearMetres = 0.15;

void drive_to_bin(const Bin& bin) {
    Worst gap("from the object, m"), contact("longest contact of the hull, s"), took("time, s");
    const TrialOptions options{.plan = example("find-object/DriveToObject.plan.json"),
                               .world = bin.world,
                               .off_metres = 0.2,
                               .off_radians = 0.5,
                               .set = bin.colour};
    try_seeds(options, [&](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok);
        EXPECT_THAT(trial.ran.states, Contains("readColour: ColourRead"));
        const double middles = metres_between(trial.ran.way.back().pose.at, bin.at);
        EXPECT_LT(gap.note(middles - kFront - bin.radius), kNearMetres);
        EXPECT_LE(contact.note(seconds(trial.longest_contact())), 2);
        took.note(seconds(trial.ran.way.back().at));
    });
}

TEST(FindObject, CarbotDrivesToTheRedBin) {
    drive_to_bin({.world = example("find-object/room.world.json"),
                  .at = {4.9, 0.9},
                  .radius = 0.12,
                  .colour = {}});
}

// On the straight way to the crate the hull meets the end of a wall.
TEST(FindObject, CarbotDrivesToAGreenCrateInANook) {
    drive_to_bin(
        {.world = test_world("nook.world.json"),
         .at = {0.9, 4.2},
         .radius = 0.15,
         .colour = {
             {"red", plan::Value(0.1)}, {"green", plan::Value(0.7)}, {"blue", plan::Value(0.2)}}});
}

// The world and the colour for which the plan was not made.
TEST(FindObject, CarbotDrivesToABlueDrumInAGarage) {
    drive_to_bin(
        {.world = test_world("garage.world.json"),
         .at = {4, 4.2},
         .radius = 0.15,
         .colour = {
             {"red", plan::Value(0.1)}, {"green", plan::Value(0.2)}, {"blue", plan::Value(0.9)}}});
}

// Hull to hull, as far as both look along the line between them: a Thymio reaches from 3 to 8 cm
// beyond its middle.
constexpr double kThymio = 0.06;
constexpr double kTooNear = 0.2;
constexpr double kTooFar = 0.7;
constexpr double kShareMin = 0.9;
constexpr double kFollowSeconds = 60;

// The share of the time after it was first near, in which it is neither too near nor too far.
double share_in_range(const Trial& trial, Worst& nearest) {
    int all = 0, inside = 0;
    for (const Moment& moment : trial.ran.way) {
        const double middles = metres_between(moment.pose.at, moment.others.at(0).at);
        const double gap = middles - kFront - kThymio;
        nearest.note(-gap);
        if (all == 0 && gap > kTooFar) continue;
        ++all;
        if (gap >= kTooNear && gap <= kTooFar) ++inside;
    }
    return all == 0 ? 0 : static_cast<double>(inside) / all;
}

void follow_leader(const TrialOptions& options) {
    Worst outside("share of time out of range"), nearest("nearest to the leader, m, negative");
    Worst contact("longest contact of the hull, s");
    try_seeds(options, [&](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok);
        EXPECT_GE(seconds(trial.ran.way.back().at), kFollowSeconds - 0.1);
        const sim::Pose& leader = trial.ran.way.front().others.at(0);
        EXPECT_GT(metres_between(leader.at, trial.ran.way.back().others.at(0).at), 0.5);
        const double share = share_in_range(trial, nearest);
        EXPECT_LE(outside.note(1 - share), 1 - kShareMin);
        EXPECT_LE(contact.note(seconds(trial.longest_contact())), 2);
    });
}

TEST(FollowObject, CarbotKeepsBehindTheRedRobot) {
    follow_leader({.plan = example("follow-object/FollowRobot.plan.json"),
                   .world = example("follow-object/hall.world.json"),
                   .off_metres = 0.2,
                   .off_radians = 0.4});
}

// The world and the colour for which the plan was not made.
TEST(FollowObject, CarbotKeepsBehindABlueRobotAmongPosts) {
    follow_leader(
        {.plan = example("follow-object/FollowRobot.plan.json"),
         .world = test_world("posts.world.json"),
         .off_metres = 0.2,
         .off_radians = 0.4,
         .set = {
             {"red", plan::Value(0.1)}, {"green", plan::Value(0.2)}, {"blue", plan::Value(0.9)}}});
}

}  // namespace
}  // namespace vagus::samples
