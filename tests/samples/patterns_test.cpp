// examples/patterns: the same plans on Carbot and on Thymio II; where they turn and where they end.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/trig.hpp"
#include "trial.hpp"

namespace vagus::samples {
namespace {

struct Bounds {
    double corner_cm;
    double end_cm;
    double end_deg;
};
// The sides add up what the wheels slip and the turns miss.
constexpr Bounds kCarbot{.corner_cm = 5, .end_cm = 5, .end_deg = 3};
constexpr Bounds kThymio{.corner_cm = 3, .end_cm = 3, .end_deg = 3};

// Where it stood when an actor began, each time.
std::vector<sim::Pose> begins_of(std::string_view actor, const Trial& trial) {
    std::vector<sim::Pose> begins;
    std::string_view before;
    for (const Moment& moment : trial.ran.way) {
        if (moment.actor == actor && before != actor) {
            begins.push_back(trial.from_begin(moment.pose));
        }
        before = moment.actor;
    }
    return begins;
}

// A side ahead, then each time to the left of that.
std::array<sim::Point, 4> corners(double side) {
    return {{{side, 0}, {side, side}, {0, side}, {0, 0}}};
}

void drive_square(const std::string& world, double side, const Bounds& bounds) {
    Worst corner("corners off, cm"), end("end off, cm"), heading("end off, degrees");
    const TrialOptions options{.plan = example("patterns/Square.plan.json"),
                               .world = world,
                               .set = {{"side", plan::Value(100 * side)}}};
    try_seeds(options, [&](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok);
        EXPECT_TRUE(trial.ran.contacts.empty());
        const std::vector<sim::Pose> turns = begins_of("turnLeft", trial);
        ASSERT_EQ(turns.size(), 4u);
        for (size_t i = 0; i < 4; ++i) {
            const double off = 100 * metres_between(turns[i].at, corners(side)[i]);
            EXPECT_LT(corner.note(off), bounds.corner_cm) << "corner " << i + 1;
        }
        EXPECT_LT(end.note(100 * metres_between(trial.end().at, {0, 0})), bounds.end_cm);
        EXPECT_LT(heading.note(degrees_off(trial.end().angle, 0)), bounds.end_deg);
    });
}

// The circles touch each other at the start: their far ends lie two radii to the left and right.
void drive_eight(const std::string& world, double radius, const Bounds& bounds) {
    Worst far("far ends off, cm"), end("end off, cm"), heading("end off, degrees");
    const TrialOptions options{.plan = example("patterns/FigureOfEight.plan.json"),
                               .world = world,
                               .set = {{"radius", plan::Value(100 * radius)}}};
    try_seeds(options, [&](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok);
        EXPECT_TRUE(trial.ran.contacts.empty());
        double left = 0, right = 0;
        for (const Moment& moment : trial.ran.way) {
            const double y = trial.from_begin(moment.pose).at.y;
            left = std::max(left, y);
            right = std::min(right, y);
        }
        EXPECT_LT(far.note(100 * std::abs(left - 2 * radius)), bounds.corner_cm);
        EXPECT_LT(far.note(100 * std::abs(right + 2 * radius)), bounds.corner_cm);
        EXPECT_LT(end.note(100 * metres_between(trial.end().at, {0, 0})), bounds.end_cm);
        EXPECT_LT(heading.note(degrees_off(trial.end().angle, 0)), bounds.end_deg);
    });
}

TEST(Patterns, CarbotDrivesASquare) {
    drive_square(example("patterns/carbot.world.json"), 1, kCarbot);
}

TEST(Patterns, TheSamePlanDrivesASquareWithAThymio) {
    drive_square(example("patterns/thymio.world.json"), 1, kThymio);
}

TEST(Patterns, CarbotDrivesAFigureOfEight) {
    drive_eight(example("patterns/carbot.world.json"), 0.4, kCarbot);
}

TEST(Patterns, TheSamePlanDrivesAFigureOfEightWithAThymio) {
    drive_eight(example("patterns/thymio.world.json"), 0.4, kThymio);
}

// A world and sizes for which the plans were not made; a longer way adds up more.
TEST(Patterns, BothPlansRunElsewhereWithOtherSizes) {
    constexpr Bounds kLonger{.corner_cm = 8, .end_cm = 8, .end_deg = 4};
    drive_square(test_world("yard.world.json"), 1.7, kLonger);
    drive_eight(test_world("yard.world.json"), 0.75, kLonger);
}

}  // namespace
}  // namespace vagus::samples
