// The templates of `drive` and `carbot` on the simulated robot. (Plans that many of them make up:
// tests/samples.)
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "base/test_places.hpp"
#include "sample_run.hpp"

namespace vagus::samples {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kPi = 3.14159265358979;

class CarbotTemplates : public ::testing::Test {
protected:
    std::string write(const std::string& name, std::string_view text) const {
        EXPECT_TRUE(write_file(folder_ / name, text).ok());
        return folder_ / name;
    }

    // A plan of these actors, from `a` on, in an empty room of 8 by 6 m. The robot starts in its
    // middle, at (4, 3), looking along x.
    Ran run(const std::string& actors, const std::string& objects = "",
            const std::string& variables = "") {
        const std::string plan = R"({ "format": "vagus-plan/1", "name": "P",
            "toolboxes": ["carbot"], "configuration": {)" +
                                 variables + R"(}, "start": { "actor": "a" }, "actors": {)" +
                                 actors + "} }";
        const std::string world = R"({ "format": "vagus-world/1", "size": [8, 6], "objects": [)" +
                                  objects +
                                  R"(], "robots": [{ "name": "carbot", "type": "carbot",
                "at": [4, 3], "script": ")" +
                                  test::examples() + R"(/carbot/carbot.aesl" }] })";
        Result<Ran> ran = run_sample({.plan = write("p.plan.json", plan),
                                      .world = write("w.world.json", world),
                                      .at_most = 120s,
                                      .traced = true});
        if (ran.ok()) return std::move(ran.value());
        // It was refused before the run.
        Ran refused;
        refused.ended.result = plan::PlanResult::Error;
        refused.ended.message = ran.error().what;
        return refused;
    }

private:
    test::Folder folder_;
};

sim::Pose end_of(const Ran& ran) {
    return ran.way.empty() ? sim::Pose{} : ran.way.back().pose;
}

// The value of the variable's last `write` in the trace.
double last_written(const Ran& ran, const std::string& variable) {
    const std::string before = "\"variable\":\"" + variable + "\",\"value\":";
    const size_t at = ran.trace.rfind(before);
    return at == std::string::npos ? NAN : std::atof(ran.trace.c_str() + at + before.size());
}

// One percent of slip and more: a robot is not exact.
void expect_pose(const Ran& ran, double x, double y, double degrees) {
    const sim::Pose end = end_of(ran);
    EXPECT_NEAR(end.at.x, x, 0.03);
    EXPECT_NEAR(end.at.y, y, 0.03);
    EXPECT_NEAR(std::remainder(end.angle * 180 / kPi - degrees, 360), 0, 2.5);
}

TEST_F(CarbotTemplates, ForwardDrivesBothWays) {
    Ran ran = run(R"("a": { "template": "Forward", "in": { "distance": 120, "speed": 31 },
                        "states": { "ForwardSuccessful": "@terminate" } })");
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Ok) << ran.ended.message;
    expect_pose(ran, 5.2, 3, 0);
    ran = run(R"("a": { "template": "Forward", "in": { "distance": -80 },
                        "states": { "ForwardSuccessful": "@terminate" } })");
    expect_pose(ran, 3.2, 3, 0);
}

TEST_F(CarbotTemplates, TurnTurnsBothWays) {
    for (const int angle : {135, -60}) {
        const Ran ran =
            run(R"("a": { "template": "Turn", "in": { "angle": )" + std::to_string(angle) + R"( },
                            "states": { "TurnSuccessful": "@terminate" } })");
        EXPECT_EQ(ran.ended.result, plan::PlanResult::Ok) << ran.ended.message;
        expect_pose(ran, 4, 3, angle);
    }
}

// A quarter of a circle of 1 m to the left: from (4, 3) to (5, 4), looking along y.
TEST_F(CarbotTemplates, CurveDrivesAnArc) {
    const Ran ran = run(R"("a": { "template": "Curve", "in": { "radius": 100, "angle": 90 },
                              "states": { "CurveSuccessful": "@terminate" } })");
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Ok) << ran.ended.message;
    expect_pose(ran, 5, 4, 90);
}

TEST_F(CarbotTemplates, NavigateToArrives) {
    const Ran ran = run(R"("a": { "template": "NavigateTo", "in": { "x": -120, "y": 90 },
                              "states": { "Arrived": "@terminate", "Stuck": "a" } })");
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Ok) << ran.ended.message;
    EXPECT_THAT(ran.states, ElementsAre("a: Arrived"));
    EXPECT_NEAR(end_of(ran).at.x, 2.8, 0.08);
    EXPECT_NEAR(end_of(ran).at.y, 3.9, 0.08);
}

// A wall is in the way; the touch stops the wheels, and that the goal does not come nearer.
TEST_F(CarbotTemplates, NavigateToSaysWhenItIsStuck) {
    const Ran ran = run(R"("a": { "template": "NavigateTo", "in": { "x": 200, "y": 0 },
                              "states": { "Arrived": "a", "Stuck": "@terminate" } })",
                        R"({ "kind": "wall", "at": [5, 3], "size": [0.1, 2], "height": 0.5 })");
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Ok) << ran.ended.message;
    EXPECT_THAT(ran.states, ElementsAre("a: Stuck"));
}

TEST_F(CarbotTemplates, ReadOdometryTellsWhereItThinksItIs) {
    const Ran ran = run(
        R"("a": { "template": "Curve", "in": { "radius": 100, "angle": 90 },
             "states": { "CurveSuccessful": "b" } },
           "b": { "template": "ReadOdometry", "out": { "x": "x", "y": "y", "heading": "h" },
             "states": { "Done": "@terminate" } })",
        "", R"("x": { "type": "float" }, "y": { "type": "float" }, "h": { "type": "float" })");
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Ok) << ran.ended.message;
    EXPECT_NEAR(last_written(ran, "x"), 100, 2);
    EXPECT_NEAR(last_written(ran, "y"), 100, 2);
    EXPECT_NEAR(last_written(ran, "h"), 90, 2);
}

// A wall 1 m to the right of the sensor's axis at an angle of 30 degrees: after the turn the robot
// is parallel to it, with the wall at its right.
TEST_F(CarbotTemplates, SearchWallGivesTheTurnToBeParallel) {
    const std::string wall =
        R"({ "kind": "wall", "at": [4.5, 2.2], "angle": 0.5236, "size": [4, 0.1], "height": 0.5 })";
    const Ran ran = run(
        R"("a": { "template": "SearchWall", "out": { "angle": "angle" },
             "states": { "WallFound": "b", "NoWallFound": "a" } },
           "b": { "template": "Turn", "in": { "angle": "angle" },
             "states": { "TurnSuccessful": "@terminate" } })",
        wall, R"("angle": { "type": "float", "initial": 0 })");
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Ok) << ran.ended.message;
    EXPECT_NEAR(end_of(ran).angle * 180 / kPi, 30, 4);
}

TEST_F(CarbotTemplates, SearchWallSaysWhenThereIsNone) {
    const Ran ran = run(R"("a": { "template": "SearchWall", "in": { "spread": 20 },
        "states": { "WallFound": "a", "NoWallFound": "@terminate" } })");
    EXPECT_THAT(ran.states, ElementsAre("a: NoWallFound"));  // 3.8 m to the wall ahead
}

// A pillar of 10 cm radius 1 m to the left of the sensor's axis (18 cm ahead of the middle).
TEST_F(CarbotTemplates, LookAroundFindsTheNearestThing) {
    const Ran ran = run(
        R"("a": { "template": "LookAround", "in": { "step": 5 },
             "out": { "angle": "angle", "nearest": "far" }, "states": { "Done": "@terminate" } })",
        R"({ "kind": "cylinder", "at": [4.18, 4], "radius": 0.1, "height": 0.5 })",
        R"("angle": { "type": "float", "initial": 0 }, "far": { "type": "float", "initial": 0 })");
    EXPECT_NEAR(last_written(ran, "far"), 90, 3);
    EXPECT_NEAR(last_written(ran, "angle"), 90, 17);  // the cone, and the pillar's width
}

// 2 m along a wall at the right, at the distance that it starts with.
TEST_F(CarbotTemplates, WallForwardKeepsItsDistance) {
    const Ran ran = run(R"("a": { "template": "WallForward",
             "in": { "distance": 50, "ahead": 40, "length": 200 },
             "states": { "ForwardSuccessful": "@terminate", "LaneNotFree": "b", "WallLost": "b" } },
           "b": { "template": "Fail", "in": { "message": "'no'" } })",
                        R"({ "kind": "wall", "at": [5, 2.3], "size": [6, 0.1], "height": 0.5 })");
    EXPECT_THAT(ran.states, ElementsAre("a: ForwardSuccessful")) << ran.ended.message;
    EXPECT_NEAR(end_of(ran).at.x, 6, 0.15);
    // The wall's face is at 2.35, half a hull is 17.5 cm: 50 cm between them is 3.025.
    EXPECT_NEAR(end_of(ran).at.y, 3.025, 0.06);
}

constexpr std::string_view kAlongWall = R"("a": { "template": "WallForward",
             "in": { "distance": 30, "ahead": 40, "length": 400 },
             "states": { "ForwardSuccessful": "@terminate", "LaneNotFree": "@terminate",
               "WallLost": "@terminate" } })";

// Along a wall of 1.5 m that is 10 cm thick, around its end, and back at the other side: 4 m.
TEST_F(CarbotTemplates, WallForwardGoesAroundTheEndOfTheWall) {
    const Ran ran =
        run(std::string(kAlongWall),
            R"({ "kind": "wall", "at": [4.2, 2.45], "size": [1.5, 0.1], "height": 0.5 })");
    EXPECT_THAT(ran.states, ElementsAre("a: ForwardSuccessful")) << ran.ended.message;
    EXPECT_LT(end_of(ran).at.y, 2.4);
    for (const Moment& moment : ran.way) EXPECT_NEAR(moment.gap, 0.3, 0.12) << moment.at.count();
}

// The same with the wall at the left; any other side is a mistake.
TEST_F(CarbotTemplates, WallForwardFollowsAWallAtTheLeftToo) {
    const std::string wall =
        R"({ "kind": "wall", "at": [4.2, 3.55], "size": [1.5, 0.1], "height": 0.5 })";
    std::string actor(kAlongWall);
    actor.replace(actor.find("400"), 3, R"(400, "side": "'left'")");
    const Ran ran = run(actor, wall);
    EXPECT_THAT(ran.states, ElementsAre("a: ForwardSuccessful")) << ran.ended.message;
    EXPECT_GT(end_of(ran).at.y, 3.6);
    for (const Moment& moment : ran.way) EXPECT_NEAR(moment.gap, 0.3, 0.12) << moment.at.count();
    actor.replace(actor.find("left"), 4, "top");
    EXPECT_THAT(run(actor, wall).ended.message, HasSubstr("\"side\" is \"top\", but must be"));
}

// The wall's face is 30 cm ahead of the hull.
TEST_F(CarbotTemplates, WallForwardEndsBeforeWhatIsInTheLane) {
    const Ran ran = run(std::string(kAlongWall),
                        R"({ "kind": "wall", "at": [4.55, 3], "size": [0.1, 2], "height": 0.5 })");
    EXPECT_THAT(ran.states, ElementsAre("a: LaneNotFree"));
}

// A plank lies before it, too low for its sensor: the touch ends its driving without a word from
// the plan, and it does not wait for ever.
TEST_F(CarbotTemplates, WallForwardNoticesThatItDoesNotMove) {
    const Ran ran = run(std::string(kAlongWall),
                        R"({ "kind": "wall", "at": [4.5, 2.47], "size": [3, 0.1], "height": 0.5 },
                           { "kind": "box", "at": [5, 3], "size": [0.1, 0.6], "height": 0.05 })");
    EXPECT_THAT(ran.states, ElementsAre("a: LaneNotFree"));
    ASSERT_EQ(ran.contacts.size(), 1u);
    EXPECT_NEAR(end_of(ran).at.x, 4.75, 0.03);
}

// The room's own walls are 3 m away: it looks for one at the right, around an end that may be
// there.
TEST_F(CarbotTemplates, WallForwardSaysWhenThereIsNoWall) {
    const Ran ran = run(std::string(kAlongWall));
    EXPECT_THAT(ran.states, ElementsAre("a: WallLost"));
    EXPECT_NEAR(end_of(ran).at.x, 4, 1);
}

// The wheels are stopped by the nodes themselves; the plan hears of it, and backs off.
TEST_F(CarbotTemplates, CheckTouchSensorHearsOfTheTouch) {
    const Ran ran = run(
        R"("a": { "template": "Forward", "in": { "distance": 300 },
             "states": { "ForwardSuccessful": "@terminate" }, "supervisors": {
               "t": { "template": "CheckTouchSensor", "out": { "angle": "angle" },
                 "events": { "TouchSensorPressed": "b" } } } },
           "b": { "template": "Forward", "in": { "distance": -20 },
             "states": { "ForwardSuccessful": "@terminate" } })",
        R"({ "kind": "wall", "at": [5, 3], "size": [0.1, 2], "height": 0.5 })",
        R"("angle": { "type": "float", "initial": 999 })");
    EXPECT_THAT(ran.states, ElementsAre("a! TouchSensorPressed", "b: ForwardSuccessful"));
    EXPECT_NEAR(last_written(ran, "angle"), 0, 30);  // of the sector
    // The hull reaches 20 cm ahead: it stood at 4.75, and is 20 cm behind that.
    EXPECT_NEAR(end_of(ran).at.x, 4.55, 0.05);
}

TEST_F(CarbotTemplates, CheckDrivingLaneSeesWhatIsInTheWay) {
    const Ran ran = run(
        R"("a": { "template": "Forward", "in": { "distance": 300 },
             "states": { "ForwardSuccessful": "@terminate" }, "supervisors": {
               "t": { "template": "CheckDrivingLane", "in": { "distance": 50 },
                 "events": { "LaneNotFree": "@terminate" } } } })",
        R"({ "kind": "wall", "at": [6, 3], "size": [0.1, 2], "height": 0.5 })");
    EXPECT_THAT(ran.states, ElementsAre("a! LaneNotFree"));
    EXPECT_TRUE(ran.contacts.empty());
    // The sensor is 18 cm ahead of the middle, the wall's face at 5.95: 50 cm before it is 5.27.
    EXPECT_NEAR(end_of(ran).at.x, 5.35, 0.1);
}

// The robot is at rest for 5 s under this supervisor, whose event is called `event`.
std::string standing(const std::string& supervisor, const std::string& event) {
    return R"("a": { "template": "Wait", "in": { "seconds": 5 },
             "states": { "Done": "@terminate" }, "supervisors": {
               "s": { )" +
           supervisor + R"(, "events": { ")" + event + R"(": "@terminate" } } } })";
}

// Noise is 1 % of the distance, at most 3.5 times that. The wall's face is 60 cm to the left of the
// sensor's axis, which is at (4.18, 3).
TEST_F(CarbotTemplates, CheckWallDistanceComparesTheDistanceFromTheSensor) {
    const std::string wall =
        R"({ "kind": "wall", "at": [4.18, 3.65], "size": [3, 0.1], "height": 0.5 })";
    const auto with = [&](const std::string& distance) {
        return run(standing(R"("template": "CheckWallDistance", "out": { "distance": "far" },
                               "in": { "distance": )" +
                                distance + " }",
                            "WallTooNear"),
                   wall, R"("far": { "type": "float", "initial": 0 })");
    };
    EXPECT_THAT(with("50").states, ElementsAre("a: Done"));
    const Ran near = with("70");
    EXPECT_THAT(near.states, ElementsAre("a! WallTooNear"));
    EXPECT_GE(last_written(near, "far"), 57.8);
    EXPECT_LT(last_written(near, "far"), 70);
}

// A post of 5 cm radius, 50 cm away at 115 degrees, at (4.18 - 0.5 cos 65, 3 + 0.5 sin 65). Its
// edge is at 115 - 6, and the cone reaches 12 degrees beyond the 90 that it looks if nothing is
// said.
TEST_F(CarbotTemplates, CheckWallDistanceLooksAsFarAsTheSensorTurns) {
    const std::string post =
        R"({ "kind": "cylinder", "at": [3.969, 3.453], "radius": 0.05, "height": 0.5 })";
    const auto with = [&](const std::string& spread) {
        return run(standing(R"("template": "CheckWallDistance",
                               "in": { "distance": 70, "spread": )" +
                                spread + " }",
                            "WallTooNear"),
                   post);
    };
    EXPECT_THAT(with("90").states, ElementsAre("a: Done"));
    EXPECT_THAT(with("120").states, ElementsAre("a! WallTooNear"));
    EXPECT_THAT(with("120.5").ended.message, HasSubstr("120"));
}

TEST_F(CarbotTemplates, MeasureDistanceLooksAsFarAsTheSensorTurns) {
    const auto with = [&](const std::string& angle) {
        return run(R"("a": { "template": "MeasureDistance", "in": { "angle": )" + angle + R"( },
                "out": { "direction": "direction" }, "states": { "Measured": "@terminate" } })",
                   "", R"("direction": { "type": "float", "initial": 0 })");
    };
    EXPECT_EQ(last_written(with("-120"), "direction"), -120);
    EXPECT_THAT(with("-120.1").ended.message, HasSubstr("from -120 to 120"));
}

// The robot is at rest for 5 s.
TEST_F(CarbotTemplates, CheckProgressHearsThatItDoesNotGetOn) {
    const auto with = [&](const std::string& seconds) {
        return run(standing(R"("template": "CheckProgress", "in": { "seconds": )" + seconds + " }",
                            "NoProgress"));
    };
    const Ran early = with("4.5");
    EXPECT_THAT(early.states, ElementsAre("a! NoProgress"));
    EXPECT_NEAR(std::chrono::duration<double>(early.way.back().at).count(), 4.5, 0.1);
    EXPECT_THAT(with("5.5").states, ElementsAre("a: Done"));
    EXPECT_THAT(with("601").ended.message, HasSubstr("from 0.1 to 600"));
}

// 2 m behind the robot: 1000 * (1 - 2 / 4) = 500.
TEST_F(CarbotTemplates, CheckInfraredHearsOfWhatIsBrightEnough) {
    const std::string beacon = R"({ "kind": "infrared", "at": [2, 3] })";
    const auto with = [&](const std::string& in) {
        return run(standing(R"("template": "CheckInfrared")" + in, "InfraredFound"), beacon);
    };
    EXPECT_THAT(with("").states, ElementsAre("a! InfraredFound"));
    EXPECT_THAT(with(R"(, "in": { "intensity": 500 })").states, ElementsAre("a! InfraredFound"));
    EXPECT_THAT(with(R"(, "in": { "intensity": 501 })").states, ElementsAre("a: Done"));
    EXPECT_THAT(with(R"(, "in": { "intensity": 1001 })").ended.message,
                HasSubstr("from 1 to 1000"));
}

}  // namespace
}  // namespace vagus::samples
