// examples/obstacle: the same plan on Carbot and on Thymio II gets past what is in its way.
#include <gmock/gmock.h>

#include <algorithm>

#include "trial.hpp"

namespace vagus::samples {
namespace {

using namespace std::chrono_literals;

// Metres from the start to the line.
struct Way {
    std::string world;
    double length;
};

// A touch moves the body a little, which its wheels do not count.
constexpr double kShortOfLine = 0.1;

void drive_to_line(const Way& way) {
    Worst off("short of the line, cm"), contact("longest contact of the hull, s");
    Worst took("time, s");
    const TrialOptions options{.plan = example("obstacle/AroundObstacle.plan.json"),
                               .world = way.world,
                               .set = {{"way", plan::Value(100 * way.length)}}};
    try_seeds(options, [&](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok);
        EXPECT_THAT(trial.ran.states, testing::Contains("driveOn! TouchSensorPressed"))
            << "nothing stood in its way";
        EXPECT_LT(off.note(100 * (way.length - trial.end().at.x)), 100 * kShortOfLine);
        EXPECT_LE(contact.note(seconds(trial.longest_contact())), 2);
        took.note(seconds(trial.ran.way.back().at));
    });
}

TEST(Obstacle, CarbotGetsPastBoxes) {
    drive_to_line({.world = example("obstacle/carbot.world.json"), .length = 3});
}

TEST(Obstacle, TheSamePlanTakesAThymioPastBoxes) {
    drive_to_line({.world = example("obstacle/thymio.world.json"), .length = 3});
}

// A post, a wall at the left where it would go aside, and a pocket between it and a slanting block:
// it has to try the other side, and to back up further.
TEST(Obstacle, CarbotGetsPastAPostBesideAWall) {
    drive_to_line({.world = test_world("post_beside_wall.world.json"), .length = 3});
}

TEST(Obstacle, TheSamePlanTakesAThymioPastAPostBesideAWall) {
    drive_to_line({.world = test_world("small_post_beside_wall.world.json"), .length = 1.5});
}

// The worlds for which the plan was not made.
TEST(Obstacle, CarbotGetsPastCrates) {
    drive_to_line({.world = test_world("crates.world.json"), .length = 3});
}

TEST(Obstacle, TheSamePlanTakesAThymioPastSmallCrates) {
    drive_to_line({.world = test_world("small_crates.world.json"), .length = 1.5});
}

}  // namespace
}  // namespace vagus::samples
