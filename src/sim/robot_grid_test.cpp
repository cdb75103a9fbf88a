// Many robots in one entry of a world file, and robots with projects of their own.
#include "sim/robot_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/test_host.hpp"
#include "sim/world.hpp"
#include "sim/world_file.hpp"

namespace vagus::sim {
namespace {

using testing::HasSubstr;

std::string with(const std::string& members) {
    return "{\"format\":\"vagus-world/1\",\"size\":[40,40],\n" + members + "}";
}

std::string error_of(const std::string& members) {
    const Result<WorldDefinition> world = read_world(with(members), "w.json");
    return world.ok() ? "" : world.error().what;
}

WorldDefinition read(const std::string& members) {
    const Result<WorldDefinition> world = read_world(with(members), "w.json");
    EXPECT_TRUE(world.ok()) << world.error().what;
    return world.ok() ? world.value() : WorldDefinition{};
}

TEST(RobotGrid, RowsAreFilledFromTheFirstRobotToTheRightAndUp) {
    const WorldDefinition world = read(
        R"("robots":[{"name":"c","type":"carbot","at":[20,20]},
            {"name":"t","type":"thymio2","at":[1,2],"angle":0.5,"grid":[3,2],"spacing":[0.5,1]},
            {"name":"last","type":"thymio2","at":[30,30]}])");
    ASSERT_EQ(world.robots.size(), 8u);
    const RobotDefinition first{.name = "t1", .at = {1, 2}, .angle = 0.5, .node = 5};
    EXPECT_EQ(world.robots[1], first);  // behind the four nodes of the Carbot
    const RobotDefinition fifth{.name = "t5", .at = {1.5, 3}, .angle = 0.5, .node = 9};
    EXPECT_EQ(world.robots[5], fifth);
    EXPECT_EQ(world.robots[7].node, 11);
}

TEST(RobotGrid, OneNumberIsTheSpacingBothWays) {
    const WorldDefinition world =
        read(R"("robots":[{"name":"t","type":"thymio2","at":[1,1],"grid":[2,2],"spacing":0.25}])");
    ASSERT_EQ(world.robots.size(), 4u);
    EXPECT_EQ(world.robots[3].at, (Point{1.25, 1.25}));
}

TEST(RobotGrid, TheMostRobotsArePossibleAndOneMoreIsNot) {
    const std::string grid =
        R"({"name":"t","type":"thymio2","at":[0.2,0.2],"grid":[100,100],"spacing":0.35})";
    EXPECT_EQ(error_of("\"robots\":[" + grid + "]"), "");
    EXPECT_THAT(
        error_of("\"robots\":[{\"name\":\"a\",\"type\":\"thymio2\",\"at\":[39,39]}," + grid + "]"),
        HasSubstr("w.json:2:54: robots[1].grid: with it there would be 10001 robots, and "
                  "10000 are the most"));
}

struct Wrong {
    const char* robot;
    const char* says;
};

TEST(RobotGrid, WhatIsWrongNamesTheEntry) {
    const Wrong cases[] = {
        {R"("grid":[101,100],"spacing":0.3)", "whole numbers from 1 on and at most 10000 robots"},
        {R"("grid":[0,1],"spacing":0.3)", "robots[0].grid: expected columns and rows"},
        {R"("grid":[1.5,2],"spacing":0.3)", "robots[0].grid: expected columns and rows"},
        {R"("grid":[2],"spacing":0.3)", "expected 2 numbers; write them as [6, 5]"},
        {R"("grid":[2,2])", "spacing"},
        {R"("grid":[2,2],"spacing":0)", "robots[0].spacing: expected metres above 0"},
        {R"("grid":[2,2],"spacing":[1,0])", "robots[0].spacing: expected metres above 0"},
        {R"("spacing":0.3)", "robots[0].spacing: is for a grid of robots"},
        {R"("grid":[2,2],"spacing":0.3,"port":4000)", "cannot share a port; write 0"},
        {R"("grid":[2,2],"spacing":0.3,"node":65533)", "would have the node 65536, and 65534"},
        {R"("grid":[2,1],"spacing":40)", "robots[0].at: [41, 1] is outside of the walls"},
    };
    for (const Wrong& one : cases) {
        const std::string text =
            R"("robots":[{"name":"t","type":"thymio2","at":[1,1],)" + std::string(one.robot) + "}]";
        EXPECT_THAT(error_of(text), HasSubstr(one.says)) << text;
    }
    EXPECT_EQ(error_of(R"("robots":[{"name":"t","type":"thymio2","at":[1,1],"grid":[2,1],)"
                       R"("spacing":[0.3,0]}])"),
              "");  // one row: nothing is above another
}

TEST(RobotGrid, AMistakeBehindAGridIsThatOfItsOwnEntry) {
    const std::string error =
        error_of(R"("robots":[{"name":"t","type":"thymio2","at":[1,1],"grid":[5,5],"spacing":1},
{"name":"a","type":"thymio2","at":[50,1]}])");
    EXPECT_THAT(error, HasSubstr("w.json:3:35: robots[1].at: [50, 1] is outside"));
    const std::string text =
        with(R"("robots":[{"name":"t","type":"thymio2","at":[1,1],"grid":[5,5],"spacing":1},
{"name":"a","type":"thymio2","at":[1,8]}])");
    EXPECT_EQ(entry_of_robot(text, "w.json", 24), 0u);
    EXPECT_EQ(entry_of_robot(text, "w.json", 25), 1u);
    const Error placed = error_in_world({Code::NotFound, "robots[25].script: no"}, text, "w.json");
    EXPECT_EQ(placed.what, "w.json:3:1: robots[1].script: no");
}

// ---- robots with a project ----

constexpr const char* kTwoWithProjects =
    R"("robots":[{"name":"a","type":"thymio2","at":[1,1],"project":"p"},
        {"name":"b","type":"thymio2","at":[2,1]},
        {"name":"c","type":"thymio2","at":[3,1],"project":"p"}])";

TEST(RobotProject, NodesCountForEachBus) {
    const WorldDefinition world = read(kTwoWithProjects);
    ASSERT_EQ(world.robots.size(), 3u);
    for (const RobotDefinition& robot : world.robots) EXPECT_EQ(robot.node, 1) << robot.name;
    EXPECT_EQ(world.robots[0].project, "p");
}

TEST(RobotProject, EachBusCarriesItsOwnFramesOnly) {
    World world = std::move(World::create(read(kTwoWithProjects)).value());
    Host common(world.bus()), of_a(world.bus_of({1})), of_c(world.bus_of({3}));
    // Local event 6, prox: v100 = 7.
    const std::vector<uint16_t> program = {3, 0xfff8, 3, 0x1007, 0x4064, 0x0000};
    of_a.load(1, program);
    world.step(std::chrono::milliseconds(500));
    EXPECT_EQ(world.variables(RobotId{1})[100], 7);
    EXPECT_EQ(world.variables(RobotId{2})[100], 0);
    EXPECT_EQ(world.variables(RobotId{3})[100], 0);
    EXPECT_EQ(world.variables_of(1)[100], 0);  // that of the common bus
    EXPECT_TRUE(common.frames().empty());
    EXPECT_TRUE(of_c.frames().empty());
}

TEST(RobotProject, ACarbotHasACanOfItsOwnAndLeavesTheCommonBusAsItIs) {
    World world = std::move(
        World::create(read(R"("robots":[{"name":"c","type":"carbot","at":[1,1],"project":"p"},
                                        {"name":"t","type":"thymio2","at":[3,1],"node":300}])"))
            .value());
    EXPECT_FALSE(world.bus_load().has_value());
    EXPECT_FALSE(world.bus_load(RobotId{2}).has_value());
    ASSERT_TRUE(world.bus_load(RobotId{1}).has_value());
    EXPECT_EQ(world.bus_load(RobotId{1})->nodes.size(), 5u);  // main, and its four
    EXPECT_TRUE(world.robots()[0].own_bus);
    EXPECT_FALSE(world.robots()[1].own_bus);
}

TEST(RobotProject, WhatDoesNotFitIsSaid) {
    EXPECT_THAT(error_of(R"("robots":[{"name":"t","type":"thymio2","at":[1,1],"project":"p",)"
                         R"("script":"s.aesl"}])"),
                HasSubstr("robots[0].script: robot t has a project, which names its scripts"));
    EXPECT_THAT(error_of(R"("robots":[{"name":"t","type":"thymio2","at":[1,1]}],)"
                         R"("timeline":[{"t":1,"do":"cut","robot":"t"}])"),
                HasSubstr("timeline[0].robot: there is no robot \"t\" with a project of its own"));
}

TEST(RobotProject, TheFleetOfAWorldIsRead) {
    const WorldDefinition world = read(
        R"("robots":[{"name":"t","type":"thymio2","at":[1,1],"project":"p"}],
           "fleet":{"latency":0.02,"jitter":0.001,"loss":0.1,"twice":0.2},
           "timeline":[{"t":1,"do":"cut","robot":"t"},{"t":2,"do":"restore"}])");
    EXPECT_EQ(world.fleet, (FleetDefinition{.latency = std::chrono::milliseconds(20),
                                            .jitter = std::chrono::milliseconds(1),
                                            .loss = 0.1,
                                            .twice = 0.2}));
    ASSERT_EQ(world.timeline.size(), 2u);
    EXPECT_EQ(std::get<CutFleet>(world.timeline[0].action), (CutFleet{"t", true}));
    EXPECT_EQ(std::get<CutFleet>(world.timeline[1].action), (CutFleet{"", false}));
    EXPECT_THAT(error_of(R"("fleet":{"loss":0.95})"),
                HasSubstr("fleet.loss: expected a number from 0 to 0.9"));
    EXPECT_THAT(error_of(R"("fleet":{"latency":60.5})"),
                HasSubstr("fleet.latency: expected a number from 0 to 60 (s), found 60.5"));
    EXPECT_THAT(error_of(R"("fleet":{"jitter":-1})"), HasSubstr("fleet.jitter"));
}

}  // namespace
}  // namespace vagus::sim
