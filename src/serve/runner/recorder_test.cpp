#include "serve/runner/recorder.hpp"

#include <gtest/gtest.h>

#include "serve/follow/sights.hpp"
#include "serve/history/tape.hpp"

namespace vagus::serve {
namespace {

constexpr size_t kMany = 900;  // Thymios, of some 1.2 kB of words each

sim::World world_of(size_t thymios) {
    sim::WorldDefinition definition;
    definition.name = "many";
    definition.width = definition.height = 20;
    for (size_t i = 0; i < thymios; ++i) {
        sim::RobotDefinition robot;
        robot.name = "r" + std::to_string(i);
        robot.at = {0.3 + 0.5 * static_cast<double>(i % 38),
                    0.3 + 0.5 * static_cast<double>(i / 38)};
        robot.node = static_cast<uint16_t>(1 + i);
        definition.robots.push_back(robot);
    }
    auto world = sim::World::create(std::move(definition));
    EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().what);
    return std::move(world.value());
}

TEST(Recorder, TheWholeOfALargeWorldIsSentOnceAndNotGivenUp) {
    const sim::World world = world_of(kMany);
    Recorder recorder;
    recorder.begin();
    recorder.look(world);
    EXPECT_TRUE(recorder.is_due_to_send());
    EXPECT_FALSE(recorder.overflows());
    const std::string records = recorder.take();
    EXPECT_GT(records.size(), kRecordsMax);
    Tape tape;
    ASSERT_TRUE(tape.record(records));
    EXPECT_EQ(tape.at(0).nodes().size(), kMany);
    EXPECT_EQ(tape.at(0).things().size(), kMany);
}

// In the frame of its robot a look that hits nothing is the same wherever the robot is.
TEST(Recorder, LooksAreWrittenWhenTheyChangeAndTurnWithTheirRobot) {
    sim::World world = world_of(1);
    const auto robot = world.find_robot("r0");
    ASSERT_TRUE(robot);
    ASSERT_TRUE(world.move(*robot, {{10, 10}, 0.5}).ok());
    Recorder recorder;
    recorder.begin();
    recorder.look(world);
    Tape tape;
    ASSERT_TRUE(tape.record(recorder.take()));
    const std::string free = tape.at(0).rays();
    EXPECT_GT(free.size(), 4 + kLookBytes);
    const auto items_after_move = [&](const sim::Pose& pose) {
        std::string kinds;
        EXPECT_TRUE(world.move(*robot, pose).ok());
        for (int i = 0; i < 25; ++i) world.step(sim::kNodeStep);
        recorder.look(world);
        const std::string records = recorder.take();
        EXPECT_TRUE(each_record(records, {.item = [&](const RecordItem& item) {
                                    kinds += static_cast<char>(item.kind);
                                }}));
        EXPECT_TRUE(tape.record(records));
        return kinds;
    };
    const std::string moved = items_after_move({{12, 7}, -1});
    EXPECT_NE(moved.find('P'), std::string::npos);
    EXPECT_EQ(moved.find('L'), std::string::npos) << moved;
    // Before the border of the world, ahead of it, it sees something.
    EXPECT_NE(items_after_move({{19.9, 7}, 0}).find('L'), std::string::npos);
    EXPECT_NE(tape.at(1).rays(), free);
    EXPECT_EQ(tape.at(1).rays().size(), free.size());
}

TEST(Recorder, LooksAreWrittenOfSoManyRobots) {
    const sim::World world = world_of(kSightRobotsMax + 1);
    Recorder recorder;
    recorder.begin();
    recorder.look(world);
    size_t robots = 0;
    ASSERT_TRUE(each_record(recorder.take(), {.item = [&](const RecordItem& item) {
                                robots += item.kind == RecordItem::Kind::Looks ? 1 : 0;
                            }}));
    EXPECT_EQ(robots, kSightRobotsMax);
}

TEST(Recorder, WhatIsGivenUpIsToldAsAWholeAgain) {
    const sim::World world = world_of(2);
    Recorder recorder;
    recorder.begin();
    recorder.look(world);
    const size_t whole = recorder.take().size();
    recorder.forget();
    recorder.begin();
    recorder.look(world);
    EXPECT_EQ(recorder.take().size(), whole);
}

}  // namespace
}  // namespace vagus::serve
