#include "serve/runner/recorder.hpp"

#include <gtest/gtest.h>

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
