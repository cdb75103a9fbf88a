// Many robots in one world: on several threads, and at rest.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/crew.hpp"
#include "sim/test_host.hpp"
#include "sim/world.hpp"

using namespace vagus;
using namespace vagus::sim;
using namespace std::chrono_literals;

namespace {

constexpr RobotId kFirst{1};

WorldDefinition one_thymio() {
    WorldDefinition definition;
    definition.width = definition.height = 2;
    definition.robots.push_back({.name = "thymio", .at = {1, 1}, .node = 1});
    return definition;
}

// 200 robots so close that they push each other, whose scripts turn at random and tell all others.
WorldDefinition crowd() {
    WorldDefinition definition;
    definition.width = definition.height = 4;
    for (uint16_t i = 0; i < 200; ++i) {
        definition.robots.push_back({.name = "r" + std::to_string(i),
                                     .at = {0.2 + 0.25 * (i % 15), 0.2 + 0.25 * (i / 15)},
                                     .angle = 0.1 * i,
                                     .node = static_cast<uint16_t>(i + 1)});
    }
    definition.objects.push_back({.id = "box",
                                  .kind = ObjectKind::Box,
                                  .at = {2, 3.8},
                                  .width = 0.1,
                                  .length = 0.1,
                                  .mass = 0.1});
    return definition;
}

// prox: v100 = v100 + 1 and both targets change; emits event 3 with the first sensor.
// user event 3: v101 = v101 + its argument.
const std::vector<uint16_t> kRestless = {
    5,      0xfff8, 5,      0x0003, 21,      // the vector: prox is local event 6
    0x3064, 0x1001, 0x8002, 0x4064,          // 5: v100 = v100 + 1
    0x3064, 0x1025, 0x8004, 0x4039,          // motor.left.target = v100 * 37
    0x3064, 0x101d, 0x8004, 0x403a,          // motor.right.target = v100 * 29
    0xb003, 0x002a, 0x0001, 0x0000,          // emit 3 prox.horizontal[0]
    0x3065, 0x3002, 0x8002, 0x4065, 0x0000,  // 21: v101 = v101 + event.args[0]
};

// Everything that can be seen of a run: what happened, where all are, all variables.
std::string told_by(unsigned threads) {
    World world = std::move(World::create(crowd(), {.threads = threads}).value());
    EXPECT_EQ(world.threads(), threads);
    Host host(world.bus());
    for (uint16_t node = 1; node <= 200; ++node) {
        host.load(node, kRestless);
        world.step(1ms);
    }
    std::string told;
    const auto tell = [&told](const auto& value) {
        told.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (int i = 0; i < 20; ++i) {
        world.step(100ms);
        for (const wire::Frame& frame : host.frames()) {
            tell(frame.source);
            tell(frame.type);
            told.append(reinterpret_cast<const char*>(frame.payload), frame.size);
        }
        for (const Happening& happening : world.happenings())
            if (const auto* contact = std::get_if<Contact>(&happening.what)) told += contact->with;
        for (const RobotView& robot : world.robots()) {
            tell(robot.pose);
            for (const int16_t word : world.variables(robot.id)) tell(word);
        }
    }
    return told;
}

TEST(Crowd, OneThreadAndTwoAndFiveGiveTheSameBytes) {
    const std::string one = told_by(1);
    EXPECT_NE(one.find("border"), std::string::npos);  // they met something
    EXPECT_NE(one.find("r1"), std::string::npos);      // and each other
    EXPECT_TRUE(one == told_by(2));
    EXPECT_TRUE(one == told_by(5));
}

TEST(Crowd, RobotsThatShareSomethingHaveOneThread) {
    WorldDefinition definition = one_thymio();
    EXPECT_EQ(World::create(definition, {.threads = 2}).value().threads(), 2u);
    EXPECT_EQ(World::create(definition).value().threads(), 1u);  // few
    EXPECT_EQ(World::create(definition, {.sd_folder = ".", .threads = 2}).value().threads(), 1u);
    definition.robots.push_back(
        {.name = "e-puck", .type = RobotType::Epuck, .at = {0.5, 0.5}, .node = 2});
    EXPECT_EQ(World::create(definition, {.threads = 2}).value().threads(), 1u);
    EXPECT_FALSE(World::create(definition, {.threads = 0}).ok());
    EXPECT_FALSE(World::create(definition, {.threads = kThreadsMax + 1}).ok());
}

// Its distance sensors are all that it is looked at for, ten times a second: no timer, no event, no
// frame. With a handler of `motor` it is a hundred times more.
TEST(Crowd, ANodeIsLookedAtOnlyWhenItIsDue) {
    World world = std::move(World::create(one_thymio()).value());
    Host host(world.bus());
    world.step(1s);
    const uint64_t start = world.turns_taken();
    world.step(60s);
    EXPECT_EQ(world.turns_taken() - start, 600u);
    host.load(1, counting({14}));  // motor
    world.step(100ms);
    const uint64_t hears = world.turns_taken();
    world.step(1s);
    EXPECT_EQ(world.turns_taken() - hears, 100u);
    EXPECT_EQ(world.variables(kFirst)[100], 110);
}

}  // namespace
