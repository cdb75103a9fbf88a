#include "sample_run.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/file.hpp"
#include "base/test_places.hpp"
#include "clearance.hpp"

namespace vagus::samples {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

// The hull is 0.4 m long and 0.35 m wide (docs/carbot.md).
std::string room(std::string_view objects) {
    return R"({ "format": "vagus-world/1", "name": "Room", "size": [4, 3],
  "objects": [)" +
           std::string(objects) + R"(],
  "robots": [{ "name": "carbot", "type": "carbot", "at": [1, 1.5], "script": ")" +
           test::examples() + R"(/carbot/carbot.aesl" }] })";
}

class SampleRunTest : public ::testing::Test {
protected:
    std::string write(const std::string& name, std::string_view text) const {
        EXPECT_TRUE(write_file(folder_ / name, text).ok());
        return folder_ / name;
    }

    // The actors of a plan, the first of which is `a`, in a world.
    Result<Ran> run(std::string_view actors, std::string_view world,
                    const std::function<bool(const Moment&)>& look = {}) {
        const std::string plan = R"({ "format": "vagus-plan/1", "name": "P",
            "toolboxes": ["drive"], "start": { "actor": "a" }, "actors": {)" +
                                 std::string(actors) + "} }";
        return run_sample({.plan = write("p.plan.json", plan),
                           .world = write("room.world.json", world),
                           .at_most = 30s,
                           .traced = true},
                          look);
    }

    static double gap(const sim::World& world, const sim::Pose& pose) {
        return clearance(world, world.robots().front(), pose);
    }

private:
    test::Folder folder_;
};

constexpr std::string_view kForward = R"(
    "a": { "template": "Forward", "in": { "distance": 100, "speed": 30 },
           "states": { "ForwardSuccessful": "@terminate" } })";

// From x = 1 to x = 2, with slip of some millimetres; 1.5 m from the walls above and below, whose
// half is the hull's: 1.5 - 0.175.
TEST_F(SampleRunTest, TellsWhereTheRobotWasAndHowThePlanEnded) {
    const auto ran = run(kForward, room(""));
    ASSERT_TRUE(ran.ok()) << ran.error().what;
    EXPECT_EQ(ran.value().ended.result, plan::PlanResult::Ok);
    EXPECT_FALSE(ran.value().called_off);
    EXPECT_THAT(ran.value().states, ElementsAre("a: ForwardSuccessful"));
    EXPECT_TRUE(ran.value().contacts.empty());
    const Moment& last = ran.value().way.back();
    EXPECT_NEAR(last.pose.at.x, 2, 0.02);
    EXPECT_NEAR(last.gap, 1.325, 0.02);
    EXPECT_EQ(last.actor, "a");
    EXPECT_THAT(ran.value().trace, HasSubstr(R"("name":"drive.arrived")"));
}

// The wall's face is at x = 1.6: the front touches it when the middle is at 1.4. The drive node
// brakes, nobody backs off: the contact lasts until the run is over.
TEST_F(SampleRunTest, TellsWhatWasTouchedAndForHowLong) {
    const auto ran =
        run(kForward, room(R"({ "kind": "wall", "at": [1.7, 1.5], "size": [0.2, 1] })"),
            [](const Moment& now) { return now.at < 10s; });
    ASSERT_TRUE(ran.ok()) << ran.error().what;
    EXPECT_TRUE(ran.value().called_off);
    EXPECT_NEAR(ran.value().way.back().pose.at.x, 1.4, 0.01);
    ASSERT_EQ(ran.value().contacts.size(), 1u);
    EXPECT_GT(ran.value().contacts.front().length, 7s);
    EXPECT_EQ(ran.value().contacts.front().from + ran.value().contacts.front().length, 10s);
}

TEST_F(SampleRunTest, AWrongPlanIsAnErrorWithItsFindings) {
    const auto ran = run(R"("a": { "template": "Fly" })", room(""));
    ASSERT_FALSE(ran.ok());
    EXPECT_THAT(ran.error().what, HasSubstr("Fly"));
}

// The face of the block is at x = 2.5 and y from 1 to 2, the disc's edge at y = 2.2 above (1, 2.4).
TEST_F(SampleRunTest, ClearanceIsThatOfTheNearestThingInTheWay) {
    const auto world = sim::World::load(room(R"({ "kind": "wall", "at": [3, 1.5], "size": [1, 1] },
                { "kind": "cylinder", "at": [1, 2.4], "radius": 0.2 },
                { "kind": "patch", "at": [1, 1.5], "size": [1, 1] })"),
                                        "room.world.json");
    ASSERT_TRUE(world.ok()) << world.error().what;
    constexpr double kRight = 1.5707963267948966;
    EXPECT_NEAR(gap(world.value(), {{1.8, 1.2}, 0}), 0.5, 1e-9);         // front to the block
    EXPECT_NEAR(gap(world.value(), {{1.8, 1.2}, kRight}), 0.525, 1e-9);  // its side to it
    EXPECT_NEAR(gap(world.value(), {{1, 1.5}, 0}), 0.525, 1e-9);         // side to the disc
    EXPECT_NEAR(gap(world.value(), {{0.6, 1}, 0}), 0.4, 1e-9);           // back to the border
    EXPECT_EQ(gap(world.value(), {{3, 1.5}, 0.3}), 0);                   // inside
    EXPECT_EQ(gap(world.value(), {{2.35, 1.5}, 0}), 0);                  // across the face
}

TEST_F(SampleRunTest, FreePosesAreFreeAndOfTheWholeRoom) {
    const std::string file = write("room.world.json", room(""));
    const auto world = sim::World::load(room(""), file);
    SplitMix64 random(1);
    double left = 4, right = 0;
    for (int i = 0; i < 100; ++i) {
        const auto pose = free_pose(file, 0.5, random);
        ASSERT_TRUE(pose.ok()) << pose.error().what;
        EXPECT_GE(gap(world.value(), pose.value()), 0.5);
        left = std::min(left, pose.value().at.x);
        right = std::max(right, pose.value().at.x);
    }
    EXPECT_LT(left, 1);
    EXPECT_GT(right, 3);
    EXPECT_FALSE(free_pose(file, 1.5, random).ok());
}

}  // namespace
}  // namespace vagus::samples
