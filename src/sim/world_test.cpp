#include "sim/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/json.hpp"
#include "sim/test_host.hpp"

using namespace vagus;
using namespace vagus::sim;
using namespace std::chrono_literals;

namespace {

wire::ListNodes list_nodes() {
    wire::ListNodes message{};
    message.version = wire::kProtocolVersion;
    return message;
}

// Avoids obstacles: each front sensor takes speed from the wheel of the other side.
//     onevent prox   motor.left.target = 300 - (prox[3] + prox[4]) / 10
//                    motor.right.target = 300 - (prox[0] + prox[1]) / 10 - prox[2] / 8
const std::vector<uint16_t> kAvoid = {
    3,      0xfff8, 3,                                               //
    0x112c, 0x302d, 0x302e, 0x8002, 0x100a, 0x8005, 0x8003, 0x4039,  // left
    0x112c, 0x302a, 0x302b, 0x8002, 0x100a, 0x8005, 0x8003,          // right …
    0x302c, 0x1008, 0x8005, 0x8003, 0x403a, 0x0000};

// Addresses in a Thymio (docs/spec, 5.2).
constexpr uint16_t kButtonCenter = 39;
constexpr uint16_t kProx = 42;
constexpr uint16_t kTargets = 57;
constexpr uint16_t kTimerPeriod = 71;

WorldDefinition with_thymio() {
    WorldDefinition world;
    world.width = 2;
    world.height = 2;
    world.robots.push_back({.name = "thymio", .at = {1, 1}});
    return world;
}

int16_t variable(const World& world, uint16_t address, uint32_t robot = 1) {
    return world.variables({robot})[address];
}

TEST(World, AThymioHasItsInitialValues) {
    WorldDefinition definition = with_thymio();
    definition.robots[0].node = 77;
    const World world = make_world(definition);
    const auto variables = world.variables({1});
    ASSERT_EQ(variables.size(), 586u);
    EXPECT_EQ(variables[0], 77);   // _id
    EXPECT_EQ(variables[34], 8);   // _productId
    EXPECT_EQ(variables[35], 11);  // _fwversion
    EXPECT_EQ(variables[36], 0);
    EXPECT_EQ(variables[66], 220);  // temperature
    EXPECT_EQ(variables[73], 0);    // sd.present: no folder was given
    const World with_card =
        make_world(definition, {.seed = {}, .folder = ".", .sd_folder = "/tmp"});
    EXPECT_EQ(with_card.variables({1})[73], 1);
}

TEST(World, EventsComeAtTheirTrueRates) {
    World world = make_world(with_thymio());
    Host host(world.bus());
    // motor, buttons, prox, acc, temperature, prox.comm, mic, sound.finished, rc5, tap
    host.load(1, counting({14, 5, 6, 9, 12, 7, 10, 11, 13, 8}));
    world.step(3s);
    // The first millisecond brings the program; nothing is due in it.
    EXPECT_EQ(variable(world, 100), 300);
    EXPECT_EQ(variable(world, 101), 60);
    EXPECT_EQ(variable(world, 102), 30);
    EXPECT_EQ(variable(world, 103), 48);
    EXPECT_EQ(variable(world, 104), 3);
    for (uint16_t never = 105; never < 110; ++never) EXPECT_EQ(variable(world, never), 0) << never;
}

TEST(World, TimersFireEveryPeriodAndAChangeRestartsThem) {
    World world = make_world(with_thymio());
    Host host(world.bus());
    host.load(1, counting({15, 16}));
    host.set(1, kTimerPeriod, {7, 1000});
    world.step(1ms);  // the periods are seen at 1 ms: due at 8, 15 … and at 1001 ms
    world.step(1000ms);
    EXPECT_EQ(variable(world, 100), 1000 / 7);
    EXPECT_EQ(variable(world, 101), 1);
    host.set(1, kTimerPeriod, {-5, 500});  // negative: none (D18)
    world.step(1ms);
    world.step(499ms);
    EXPECT_EQ(variable(world, 100), 1000 / 7);
    EXPECT_EQ(variable(world, 101), 1);
    world.step(1ms);
    EXPECT_EQ(variable(world, 101), 2);
}

TEST(World, AButtonTellsPressAndRelease) {
    World world = make_world(with_thymio());
    Host host(world.bus());
    host.load(1, counting({2, 3}));
    world.step(1ms);
    const RobotId robot = world.find_robot("thymio").value();
    ASSERT_TRUE(world.press(robot, "center").ok());
    EXPECT_EQ(variable(world, kButtonCenter), 1);
    world.step(1ms);
    EXPECT_EQ(variable(world, 100), 1);
    ASSERT_TRUE(world.press(robot, "center").ok());  // it is pressed: nothing happens
    world.step(1ms);
    EXPECT_EQ(variable(world, 100), 1);
    ASSERT_TRUE(world.release(robot, "center").ok());
    world.step(1ms);
    EXPECT_EQ(variable(world, kButtonCenter), 0);
    EXPECT_EQ(variable(world, 100), 2);
    EXPECT_EQ(variable(world, 101), 0);
    const Status wrong = world.press(robot, "middle");
    ASSERT_FALSE(wrong.ok());
    EXPECT_NE(wrong.error().what.find("backward, left, center, forward, right"), std::string::npos);
    EXPECT_FALSE(world.press({2}, "center").ok());
}

TEST(World, ATapAndACollisionAreTheSameEvent) {
    WorldDefinition definition = with_thymio();
    definition.objects.push_back(
        {.id = "post", .kind = ObjectKind::Cylinder, .at = {1.12, 1}, .radius = 0.02});
    World world = make_world(definition);
    Host host(world.bus());
    host.load(1, counting({8}));
    ASSERT_TRUE(world.tap({1}).ok());
    world.step(2ms);
    EXPECT_EQ(variable(world, 100), 1);
    host.set(1, kTargets, {200, 200});
    std::vector<std::string> touched;
    for (int i = 0; i < 10; ++i) {
        world.step(100ms);
        for (const Happening& happening : world.happenings())
            if (const auto* contact = std::get_if<Contact>(&happening.what))
                touched.push_back(contact->with);
    }
    EXPECT_EQ(touched, std::vector<std::string>{"post"});
    EXPECT_EQ(variable(world, 100), 2);
}

// 33 is too much and -1 is less than nothing: both are 32 (docs/spec, 4.6).
TEST(World, LedsTakeTheMostForTooMuchAndForLessThanNothing) {
    World world = make_world(with_thymio());
    Host host(world.bus());
    host.set(1, 100, {16, 33, -1});
    // init: leds.top(v100, v101, v102), native 35; addresses are pushed last argument first.
    host.load(1, {3, 0xffff, 3, 0x1066, 0x1065, 0x1064, 0xc023, 0x0000});
    world.step(1ms);
    const std::vector<Lamp> lamps = world.lamps({1});
    ASSERT_EQ(lamps[0].name, "leds.top");
    EXPECT_EQ(lamps[0].colour, (Colour{0.5, 1, 1}));
    EXPECT_EQ(lamps[1].colour, (Colour{0, 0, 0}));
}

TEST(World, FiveSecondsAtFiveHundredAreEightyThreeCentimetres) {
    WorldDefinition definition = with_thymio();
    definition.robots[0].at = {0.3, 1};
    World world = make_world(definition);
    Host host(world.bus());
    host.set(1, kTargets, {500, 500});
    world.step(5s);
    EXPECT_NEAR(world.robots()[0].pose.at.x, 0.3 + 0.83, 0.004);
    EXPECT_EQ(variable(world, 59), 500);  // motor.left.speed
}

TEST(World, ASensorShowsTheWallAfterATenthOfASecond) {
    WorldDefinition definition = with_thymio();
    definition.objects.push_back(
        {.kind = ObjectKind::Wall, .at = {1.125, 1}, .width = 0.01, .length = 0.5});
    World world = make_world(definition);
    world.step(99ms);
    EXPECT_EQ(variable(world, kProx + 2), 0);
    world.step(1ms);
    EXPECT_NEAR(variable(world, kProx + 2), 3687, 60);  // 12 cm: docs/sensors.md
}

TEST(World, ANodeDescribesItselfOverTheBus) {
    WorldDefinition definition = with_thymio();
    definition.robots.push_back(
        {.name = "e", .type = RobotType::Epuck, .at = {0.5, 0.5}, .node = 2});
    World world = make_world(definition);
    Host host(world.bus());
    host.send(list_nodes());
    wire::GetNodeDescription ask{};
    ask.version = 5;
    for (const uint16_t node : {uint16_t{1}, uint16_t{2}}) {
        ask.dest = node;
        host.send(ask);
    }
    world.step(1ms);
    std::map<uint16_t, wire::Description> headers;
    std::map<uint16_t, size_t> bytes;
    const std::vector<wire::Frame> frames = host.frames();
    for (const wire::Frame& frame : frames) {
        bytes[frame.source] += 6u + frame.size;
        wire::Description header;
        if (wire::decode_message(frame, header) == wire::Error::None)
            headers[frame.source] = header;
    }
    ASSERT_EQ(headers.size(), 2u);
    const wire::Description& thymio = headers[1];
    EXPECT_EQ(std::string(thymio.name.bytes, thymio.name.size), "thymio-II");
    EXPECT_EQ(thymio.bytecode_size, 1534);
    EXPECT_EQ(thymio.stack_size, 32);
    EXPECT_EQ(thymio.variables_size, 586);
    EXPECT_EQ(thymio.variable_count, 30);
    EXPECT_EQ(thymio.local_event_count, 17);
    EXPECT_EQ(thymio.native_count, 52);
    const wire::Description& epuck = headers[2];
    EXPECT_EQ(std::string(epuck.name.bytes, epuck.name.size), "e-puck1");
    EXPECT_EQ(epuck.variables_size, 485);
    EXPECT_EQ(epuck.native_count, 33);
    // NodePresent, the description, and one message for each item.
    EXPECT_EQ(frames.size(), 2u + 2u + (30 + 17 + 52) + (14 + 2 + 33));
}

TEST(World, UserEventsReachTheOtherRobotAndTheHostAMillisecondLater) {
    WorldDefinition definition = with_thymio();
    definition.robots.push_back({.name = "second", .at = {0.5, 0.5}, .node = 2});
    World world = make_world(definition);
    Host host(world.bus());
    host.set(1, 100, {42});
    host.load(1, {3, id_of(14), 3, 0xb003, 100, 1, 0x0000});  // on motor: emit 3 [v100]
    host.load(2, {3, 3, 3, 0x3002, 0x4064, 0x0000});          // on event 3: v100 = args[0]
    world.step(10ms);
    EXPECT_EQ(variable(world, 100, 2), 0);
    ASSERT_EQ(world.happenings().size(), 1u);
    const Happening& happening = world.happenings()[0];
    EXPECT_EQ(happening.at, Time(10ms));
    EXPECT_EQ(happening.node, 1);
    EXPECT_EQ(std::get<Emitted>(happening.what).event, 3);
    EXPECT_EQ(std::get<Emitted>(happening.what).arguments, std::vector<int16_t>{42});
    world.step(1ms);
    EXPECT_EQ(variable(world, 100, 2), 42);
    EXPECT_EQ(variable(world, 1, 2), 1);  // event.source
}

TEST(World, AFaultIsToldWithItsPlace) {
    World world = make_world(with_thymio());
    Host host(world.bus());
    host.load(1, {3, id_of(14), 3, 0x1001, 0x1000, 0x8005, 0x4064, 0x0000});  // 1 / 0
    world.step(10ms);
    ASSERT_EQ(world.happenings().size(), 1u);
    EXPECT_EQ(std::get<Fault>(world.happenings()[0].what).what, "division by zero");
    EXPECT_EQ(std::get<Fault>(world.happenings()[0].what).pc, 5);
}

TEST(World, PosesAreToldTenTimesASecond) {
    World world = make_world(with_thymio());
    world.step(1s);
    size_t poses = 0;
    for (const Happening& happening : world.happenings())
        if (std::holds_alternative<PoseNote>(happening.what)) ++poses;
    EXPECT_EQ(poses, 10u);
}

TEST(World, TheTimelineActsAtItsInstants) {
    WorldDefinition definition = with_thymio();
    definition.objects = {
        {.id = "wall", .kind = ObjectKind::Wall, .at = {1.5, 1}, .width = 0.1, .length = 1},
        {.id = "lamp", .kind = ObjectKind::Light, .at = {1, 1}}};
    definition.timeline = {
        {Time(0),
         AddObject{{.id = "first", .kind = ObjectKind::Patch, .at = {0.1, 0.1}, .radius = 0.01}}},
        {Time(10ms), MoveObject{"wall", {1.6, 1.1}, std::nullopt}},
        {Time(20ms), MoveObject{"thymio", {0.5, 0.6}, 1.0}},
        {Time(30ms), SwitchLight{"lamp", false}},
        {Time(40ms), PressButton{"thymio", "center", true}},
        {Time(50ms), RemoveObject{"wall"}}};
    World world = make_world(definition);
    EXPECT_TRUE(world.find_object("first").has_value());
    EXPECT_EQ(world.objects()[0].pose.at.x, 1.5);
    world.step(10ms);
    EXPECT_NEAR(world.objects()[0].pose.at.x, 1.6, 1e-6);
    EXPECT_NEAR(world.objects()[0].pose.at.y, 1.1, 1e-6);
    EXPECT_NEAR(world.robots()[0].pose.at.x, 1, 1e-6);
    world.step(10ms);
    EXPECT_NEAR(world.robots()[0].pose.at.x, 0.5, 1e-6);
    EXPECT_NEAR(world.robots()[0].pose.angle, 1, 1e-6);
    EXPECT_TRUE(world.objects()[1].on);
    world.step(10ms);
    EXPECT_FALSE(world.objects()[1].on);
    EXPECT_EQ(variable(world, kButtonCenter), 0);
    world.step(10ms);
    EXPECT_EQ(variable(world, kButtonCenter), 1);
    world.step(10ms);
    EXPECT_FALSE(world.find_object("wall").has_value());
}

TEST(World, HandlesOfObjectsAreNeverUsedAgain) {
    World world = make_world(with_thymio());
    const ObjectDefinition box = {
        .id = "box", .kind = ObjectKind::Box, .at = {0.5, 0.5}, .width = 0.1, .length = 0.1};
    const ObjectId first = world.add(box).value();
    EXPECT_FALSE(world.add(box).ok());  // the id is taken
    EXPECT_FALSE(world.switch_light(first, true).ok());
    EXPECT_TRUE(world.move(first, {{0.6, 0.5}, 0}).ok());
    EXPECT_TRUE(world.remove(first).ok());
    EXPECT_FALSE(world.remove(first).ok());
    EXPECT_FALSE(world.move(first, {{0.6, 0.5}, 0}).ok());
    const ObjectId second = world.add(box).value();
    EXPECT_NE(first, second);
    world.reset();
    EXPECT_FALSE(world.find_object("box").has_value());
    EXPECT_GT(world.add(box).value(), second);
    ObjectDefinition named = box;
    named.id = "thymio";
    EXPECT_FALSE(world.add(named).ok());
}

TEST(World, OneMoreObjectThanTheMostIsRefused) {
    WorldDefinition definition = with_thymio();
    definition.objects.assign(kObjectsMax, {.kind = ObjectKind::Light, .at = {1, 1}});
    World world = make_world(definition);
    const Result<ObjectId> added = world.add({.kind = ObjectKind::Light, .at = {1, 1}});
    ASSERT_FALSE(added.ok());
    EXPECT_EQ(added.error().code, Code::Limit);
}

TEST(World, TenThousandRobotsLiveInOneWorldAndOneMoreDoesNot) {
    WorldDefinition definition;
    definition.width = definition.height = 51;
    for (size_t i = 0; i < kRobotsMax; ++i) {
        definition.robots.push_back({.name = "r" + std::to_string(i),
                                     .at = {0.3 + 0.5 * static_cast<double>(i % 100),
                                            0.3 + 0.5 * static_cast<double>(i / 100)},
                                     .node = static_cast<uint16_t>(i + 1)});
    }
    World world = make_world(definition);
    Host host(world.bus());
    host.set(kRobotsMax, kTargets, {100, 100});
    const double before = world.robots().back().pose.at.x;
    world.step(200ms);
    EXPECT_GT(world.robots().back().pose.at.x, before + 0.005);
    definition.robots.push_back({.name = "last", .at = {50.8, 50.8}, .node = 10001});
    EXPECT_FALSE(World::create(definition).ok());
}

TEST(World, WhatHappensBeyondTheLimitIsCounted) {
    World world = make_world(with_thymio());
    Host host(world.bus());
    // init: emit event 0 without arguments, for ever: 500 a millisecond.
    host.load(1, {3, 0xffff, 3, 0xb000, 0, 0, 0x9ffd});
    world.step(1s);
    EXPECT_EQ(world.happenings().size(), kHappeningsMax);
    // 500 in each millisecond, the first one included, and 10 poses.
    EXPECT_EQ(world.happenings_lost(), 500u * 1000 + 10 - kHappeningsMax);
}

TEST(World, ARobotWithAPortIsAloneOnItsPrivateBus) {
    WorldDefinition definition = with_thymio();
    definition.robots[0].port = 4000;
    definition.robots.push_back({.name = "second", .at = {0.5, 0.5}, .node = 2});
    World world = make_world(definition);
    EXPECT_EQ(world.private_bus({2}), nullptr);
    ASSERT_NE(world.private_bus({1}), nullptr);
    Host host(*world.private_bus({1}));
    host.send(list_nodes());
    world.step(1ms);
    const std::vector<wire::Frame> frames = host.frames();
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].source, 1);
}

TEST(World, ACarbotIsFourNodesOnBothItsBuses) {
    WorldDefinition definition = with_thymio();
    definition.robots[0].node = 9;
    definition.robots.push_back(
        {.name = "carbot", .type = RobotType::Carbot, .at = {0.5, 0.5}, .node = 5, .port = 4000});
    World world = make_world(definition);
    EXPECT_EQ(world.robots()[1].nodes, 4);
    Host host(world.bus());
    Host own(*world.private_bus({2}));
    host.send(list_nodes());
    own.send(list_nodes());
    world.step(2ms);  // the answers cross the CAN bus
    std::vector<uint16_t> seen;
    for (const wire::Frame& frame : host.frames()) seen.push_back(frame.source);
    // Those of the Carbot were asked twice, over each bus, and tell both; the Thymio once.
    EXPECT_EQ(seen, (std::vector<uint16_t>{5, 5, 6, 6, 7, 7, 8, 8, 9}));
    EXPECT_EQ(own.frames().size(), 8u);
    EXPECT_EQ(world.variables_of(7)[0], 7);
    EXPECT_TRUE(world.variables_of(10).empty());
}

TEST(World, AfterAResetEverythingIsAsAtTheStart) {
    WorldDefinition definition = with_thymio();
    definition.objects.push_back({.id = "box",
                                  .kind = ObjectKind::Box,
                                  .at = {1.3, 1},
                                  .width = 0.1,
                                  .length = 0.1,
                                  .mass = 0.1});
    World world = make_world(definition);
    Host host(world.bus());
    host.set(1, kTargets, {400, 400});
    world.step(5s);
    EXPECT_GT(world.objects()[0].pose.at.x, 1.35);
    host.set(1, kTargets, {100, 100});  // on its way: must not reach the new robot
    world.reset();
    EXPECT_EQ(world.now(), Time{});
    EXPECT_NEAR(world.objects()[0].pose.at.x, 1.3, 1e-6);
    EXPECT_NEAR(world.robots()[0].pose.at.x, 1, 1e-6);
    world.step(1s);
    EXPECT_NEAR(world.robots()[0].pose.at.x, 1, 1e-6);
    host.frames();
    host.send(list_nodes());
    world.step(1ms);
    EXPECT_EQ(host.frames().size(), 1u);
}

// FNV-1a over the bits of what is told.
class Hash {
public:
    void add(const void* data, size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3u;
    }
    void add(double value) { add(&value, sizeof value); }
    uint64_t value() const { return value_; }

private:
    uint64_t value_ = 0xcbf29ce484222325u;
};

// 20 s of five Thymios and an e-puck that avoid each other, a box and posts; steps of `span`.
uint64_t hash_of_run(Duration span, uint64_t seed) {
    WorldDefinition definition;
    definition.width = definition.height = 1.5;
    definition.objects = {
        {.kind = ObjectKind::Cylinder, .at = {0.7, 0.7}, .radius = 0.05},
        {.kind = ObjectKind::Box, .at = {0.3, 1.1}, .angle = 0.4, .width = 0.2, .length = 0.1},
        {.kind = ObjectKind::Box, .at = {1.1, 0.4}, .width = 0.1, .length = 0.1, .mass = 0.2}};
    for (uint16_t i = 0; i < 5; ++i) {
        definition.robots.push_back({.name = "t" + std::to_string(i),
                                     .at = {0.25 + 0.25 * i, 0.25},
                                     .angle = 0.7 * i,
                                     .node = static_cast<uint16_t>(i + 1)});
    }
    definition.robots.push_back(
        {.name = "e", .type = RobotType::Epuck, .at = {1, 1.2}, .angle = 2, .node = 9});
    World world = make_world(definition, {.seed = seed, .folder = ".", .sd_folder = ""});
    Host host(world.bus());
    for (uint16_t node = 1; node <= 5; ++node) host.load(node, kAvoid);
    host.set(9, 35, {400, 450});
    Hash hash;
    for (Duration done{}; done < 20s; done += span) {
        world.step(span);
        for (const Happening& happening : world.happenings()) {
            hash.add(&happening.at, sizeof happening.at);
            if (const auto* note = std::get_if<PoseNote>(&happening.what)) {
                hash.add(note->pose.at.x);
                hash.add(note->pose.at.y);
                hash.add(note->pose.angle);
            }
            if (const auto* contact = std::get_if<Contact>(&happening.what))
                hash.add(contact->with.data(), contact->with.size());
        }
    }
    return hash.value();
}

TEST(World, TwoHalvesOfAnInstantAreAStep) {
    World whole = make_world(with_thymio());
    World halves = make_world(with_thymio());
    Host(whole.bus()).set(1, kTargets, {300, 200});
    Host(halves.bus()).set(1, kTargets, {300, 200});
    size_t poses = 0;
    for (int i = 0; i < 2000; ++i) {
        whole.step(1ms);
        halves.begin_instant();
        EXPECT_EQ(halves.now(), (i + 1) * 1ms);
        halves.end_instant();
        poses += halves.happenings().size();
    }
    EXPECT_EQ(halves.robots()[0].pose, whole.robots()[0].pose);
    EXPECT_EQ(poses, 20u) << "ten a second";
}

TEST(World, TheSameRunIsTheSameToTheLastBit) {
    const uint64_t whole = hash_of_run(20s, 1);
    EXPECT_EQ(whole, hash_of_run(20s, 1));
    EXPECT_EQ(whole, hash_of_run(2500us, 1)) << "the size of the steps does not matter";
    EXPECT_NE(whole, hash_of_run(20s, 2)) << "the noise follows the seed";
}

// Changes when physics, sensors or the order of things change: then look whether that was meant.
TEST(World, TheRunOfTwentySecondsIsTheGoldenOne) {
    EXPECT_EQ(hash_of_run(20s, 1), 3955309112562815656u);
}

}  // namespace
