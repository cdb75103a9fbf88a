// Carbot's templates with eyes, on the simulated robot: what they find, follow and read. What they
// look for stands in rooms of 8 by 6 m, the robot in the middle at (4, 3), looking along x.
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
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kPi = 3.14159265358979;

struct Scene {
    std::string actor;  // the plan's only one, a JSON member
    std::string objects = "";
    std::string timeline = "";
    uint64_t seed = 1;
    std::string type = "carbot";
};

class Eyes : public ::testing::Test {
protected:
    std::string write(const std::string& name, const std::string& text) const {
        EXPECT_TRUE(write_file(folder_ / name, text).ok());
        return folder_ / name;
    }

    Ran run(const Scene& scene) {
        const std::string plan = R"({ "format": "vagus-plan/1", "name": "P",
            "toolboxes": ["carbot"], "configuration": {
                "angle": { "type": "float" }, "distance": { "type": "float" },
                "red": { "type": "float" }, "green": { "type": "float" },
                "blue": { "type": "float" }, "colour": { "type": "string" } },
            "start": { "actor": "a" }, "actors": {)" +
                                 scene.actor + "} }";
        const std::string world =
            R"({ "format": "vagus-world/1", "size": [8, 6], "objects": [)" + scene.objects +
            R"(], "timeline": [)" + scene.timeline + R"(], "robots": [{ "name": "r", "type": ")" +
            scene.type + R"(", "at": [4, 3], "script": ")" + test::examples() +
            (scene.type == "carbot" ? "/carbot/carbot.aesl" : "/thymio/drive.aesl") + R"(" }] })";
        Result<Ran> ran = run_sample({.plan = write("p.plan.json", plan),
                                      .world = write("w.world.json", world),
                                      .seed = scene.seed,
                                      .at_most = 120s,
                                      .traced = true});
        EXPECT_TRUE(ran.ok()) << ran.error().what;
        return ran.ok() ? std::move(ran.value()) : Ran{};
    }

private:
    test::Folder folder_;
};

sim::Pose end_of(const Ran& ran) {
    return ran.way.empty() ? sim::Pose{} : ran.way.back().pose;
}

// Degrees from where the robot looks to that place.
double bearing(const Ran& ran, double x, double y) {
    const sim::Pose end = end_of(ran);
    const double way = std::atan2(y - end.at.y, x - end.at.x);
    return std::remainder(way - end.angle, 2 * kPi) * 180 / kPi;
}

double gap(const Ran& ran, double x, double y) {
    return std::hypot(x - end_of(ran).at.x, y - end_of(ran).at.y);
}

// The text of the variable's last `write` in the trace.
std::string last_written(const Ran& ran, const std::string& variable) {
    const std::string before = "\"variable\":\"" + variable + "\",\"value\":";
    const size_t at = ran.trace.rfind(before);
    if (at == std::string::npos) return "";
    const size_t from = at + before.size();
    return ran.trace.substr(from, ran.trace.find(",\"by\"", from) - from);
}

const std::string kFind = R"("a": { "template": "FindObject",
    "out": { "angle": "angle", "distance": "distance" },
    "states": { "ObjectFound": "@terminate", "NoObjectFound": "@terminate" } })";
const std::string kFollow = R"("a": { "template": "FollowObject",
    "in": { "distance": 30 }, "out": { "angle": "angle", "distance": "distance" },
    "states": { "ObjectReached": "@terminate", "ObjectLost": "@terminate" } })";

std::string post(double x, double y, const std::string& colour, const std::string& id = "post",
                 double height = 0.3) {
    return R"({ "id": ")" + id + R"(", "kind": "cylinder", "at": [)" + std::to_string(x) + ", " +
           std::to_string(y) + R"(], "radius": 0.1, "height": )" + std::to_string(height) +
           R"(, "colour": )" + colour + " }";
}
const std::string kRed = "[0.9, 0.1, 0.1]";
const std::string kBlue = "[0.1, 0.2, 0.9]";

// ---- FindObject ----

// Behind the robot, 1.5 m away. When it has turned, the post's foot is 1.4 m from the robot's
// middle, so 1.2 m from its front.
TEST_F(Eyes, FindObjectTurnsUntilTheObjectIsAhead) {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Ran ran = run({.actor = kFind, .objects = post(2.5, 3, kRed), .seed = seed});
        EXPECT_THAT(ran.states, ElementsAre("a: ObjectFound"));
        EXPECT_NEAR(bearing(ran, 2.5, 3), 0, 5) << seed;
        EXPECT_NEAR(gap(ran, 4, 3), 0, 0.1) << seed;
        EXPECT_NEAR(std::stod(last_written(ran, "distance")), 120, 8) << seed;
    }
}

TEST_F(Eyes, FindObjectTurnsTheWayThatItIsTold) {
    const Ran ran = run({.actor = R"("a": { "template": "FindObject",
            "in": { "turn": -120, "speed": 30 },
            "states": { "ObjectFound": "@terminate", "NoObjectFound": "@terminate" } })",
                         .objects = post(4, 1.5, kRed)});
    EXPECT_THAT(ran.states, ElementsAre("a: ObjectFound"));
    EXPECT_NEAR(end_of(ran).angle * 180 / kPi, -90, 6);
}

TEST_F(Eyes, FindObjectDoesNotTakeAnotherColourOrWhatIsHidden) {
    const std::string wall =
        R"(, { "kind": "wall", "at": [5.5, 3], "size": [0.1, 3], "height": 0.5 })";
    const Ran ran = run(
        {.actor = kFind, .objects = post(2.5, 3, kBlue) + ", " + post(6.5, 3, kRed, "b") + wall});
    EXPECT_THAT(ran.states, ElementsAre("a: NoObjectFound"));
    EXPECT_NEAR(std::fabs(bearing(ran, 8, 3)), 0, 25);  // once around
}

TEST_F(Eyes, ACameraTemplateWithoutACameraIsAnErrorThatSaysSo) {
    const Ran ran = run({.actor = kFind, .type = "thymio2"});
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(ran.ended.message, HasSubstr("FindObject needs a camera, and there is none"));
}

TEST_F(Eyes, AGreyColourIsAnErrorThatSaysSo) {
    const Ran ran = run({.actor = R"("a": { "template": "FindObject",
            "in": { "red": 0.5, "green": 0.5, "blue": 0.5 },
            "states": { "ObjectFound": "@terminate", "NoObjectFound": "@terminate" } })"});
    EXPECT_EQ(ran.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(ran.ended.message, HasSubstr("the colour 0.5, 0.5, 0.5 is too grey"));
}

// ---- FollowObject ----

// 30 cm before the front: 20 + 30 + 10 (the post's radius) from the middle of the robot.
TEST_F(Eyes, FollowObjectDrivesToTheObject) {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Ran ran = run({.actor = kFollow, .objects = post(6, 3.6, kRed), .seed = seed});
        EXPECT_THAT(ran.states, ElementsAre("a: ObjectReached"));
        EXPECT_NEAR(gap(ran, 6, 3.6), 0.60, 0.06) << seed;
        EXPECT_NEAR(bearing(ran, 6, 3.6), 0, 15) << seed;
    }
}

// Lower than the distance sensor's eye: only how wide it looks tells how near it is.
TEST_F(Eyes, FollowObjectDrivesToALowObject) {
    const Ran ran = run({.actor = kFollow, .objects = post(6, 3, kRed, "post", 0.07)});
    EXPECT_THAT(ran.states, ElementsAre("a: ObjectReached"));
    EXPECT_NEAR(gap(ran, 6, 3), 0.60, 0.1);
}

// Too wide to be seen whole and too low to be heard: the last 12 cm by what has been driven. Its
// face is at 5.95 m, so the front stops at 5.65 and the middle of the robot at 5.45.
TEST_F(Eyes, FollowObjectDrivesToALowWideObject) {
    const Ran ran =
        run({.actor = kFollow, .objects = R"({ "kind": "wall", "at": [6, 3], "size": [0.1, 1.2],
                                         "height": 0.08, "colour": [0.9, 0.1, 0.1] })"});
    EXPECT_THAT(ran.states, ElementsAre("a: ObjectReached"));
    EXPECT_NEAR(end_of(ran).at.x, 5.45, 0.08);
    EXPECT_TRUE(ran.contacts.empty());
}

// The post goes on by 10 cm twice a second: 20 cm/s, as fast as the robot may drive, from 1.5 to
// 3.4 m ahead and to the left. When it stands, the robot catches up with it.
TEST_F(Eyes, FollowObjectFollowsWhatMoves) {
    std::string timeline;
    double x = 5.5;
    double y = 3;
    for (int i = 1; i <= 19; ++i) {
        x += 0.08;
        y += 0.06;
        timeline += (i > 1 ? ", " : "") + (R"({ "t": )" + std::to_string(0.5 * i) +
                                           R"(, "do": "move", "id": "post", "at": [)" +
                                           std::to_string(x) + ", " + std::to_string(y) + "] }");
    }
    const Ran ran = run({.actor = kFollow, .objects = post(5.5, 3, kRed), .timeline = timeline});
    EXPECT_THAT(ran.states, ElementsAre("a: ObjectReached"));
    EXPECT_NEAR(gap(ran, x, y), 0.60, 0.08);
}

// A second one of the same colour, nearer to the robot, comes beside: the first one is kept.
TEST_F(Eyes, FollowObjectKeepsToTheOneThatItFollows) {
    const Ran ran = run({.actor = kFollow,
                         .objects = post(6.5, 3.3, kRed),
                         .timeline = R"({ "t": 1, "do": "add", "object": )" +
                                     post(5.6, 2.5, kRed, "other") + " }"});
    EXPECT_THAT(ran.states, ElementsAre("a: ObjectReached"));
    EXPECT_NEAR(gap(ran, 6.5, 3.3), 0.60, 0.08);
}

TEST_F(Eyes, FollowObjectSaysWhenTheObjectIsLost) {
    const Ran ran = run({.actor = kFollow,
                         .objects = post(6.5, 3, kRed),
                         .timeline = R"({ "t": 2, "do": "remove", "id": "post" })"});
    EXPECT_THAT(ran.states, ElementsAre("a: ObjectLost"));
    EXPECT_LT(end_of(ran).at.x, 5);
}

// ---- FindInfrared ----

const std::string kInfrared = R"("a": { "template": "FindInfrared",
    "states": { "InfraredReached": "@terminate", "NoInfraredFound": "@terminate" } })";

// 900 is 40 cm from the beacon; the robot rolls on a little.
TEST_F(Eyes, FindInfraredDrivesToTheBeacon) {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Ran ran = run({.actor = kInfrared,
                             .objects = R"({ "id": "lamp", "kind": "infrared", "at": [2.5, 4.5] })",
                             .seed = seed});
        EXPECT_THAT(ran.states, ElementsAre("a: InfraredReached"));
        EXPECT_NEAR(gap(ran, 2.5, 4.5), 0.40, 0.06) << seed;
    }
}

TEST_F(Eyes, FindInfraredSaysWhenThereIsNone) {
    const Ran ran = run({.actor = kInfrared});
    EXPECT_THAT(ran.states, ElementsAre("a: NoInfraredFound")) << ran.ended.message;
    EXPECT_NEAR(gap(ran, 4, 3), 0, 0.01);
}

// ---- ReadColour ----

const std::string kRead = R"("a": { "template": "ReadColour",
    "out": { "red": "red", "green": "green", "blue": "blue", "name": "colour" },
    "states": { "ColourRead": "@terminate", "NoColour": "@terminate" } })";

// 10 cm before the front, at 4.2 m. The head has looked 50 ms after the start.
TEST_F(Eyes, ReadColourTellsWhatIsAhead) {
    const std::string after = R"("a": { "template": "Wait", "in": { "seconds": 0.1 },
        "states": { "Done": "b" } }, "b")";
    const Ran ran =
        run({.actor = after + kRead.substr(3), .objects = post(4.4, 3, "[0.1, 0.8, 0.2]")});
    EXPECT_THAT(ran.states, ElementsAre("a: Done", "b: ColourRead"));
    EXPECT_EQ(last_written(ran, "red"), "0.1");
    EXPECT_EQ(last_written(ran, "green"), "0.8");
    EXPECT_EQ(last_written(ran, "blue"), "0.2");
    EXPECT_EQ(last_written(ran, "colour"), "\"green\"");
}

TEST_F(Eyes, ReadColourSaysWhenNothingIsThere) {
    EXPECT_THAT(run({.actor = kRead}).states, ElementsAre("a: NoColour"));
}

// ---- the same bits ----

TEST_F(Eyes, TheSamePursuitTwiceIsTheSameTrace) {
    const Scene scene = {.actor = kFollow, .objects = post(6, 3.6, kRed)};
    EXPECT_EQ(run(scene).trace, run(scene).trace);
}

}  // namespace
}  // namespace vagus::samples
