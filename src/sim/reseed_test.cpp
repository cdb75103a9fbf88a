// World::reseed(): what is random from an instant on is drawn from another seed, and nothing else
// changes. math.rand is tried by tests/recordings/turning_test.py, with scripts.
#include <gtest/gtest.h>

#include "sim/host_chaos.hpp"
#include "sim/test_host.hpp"
#include "sim/world.hpp"

namespace vagus::sim {
namespace {

using namespace std::chrono_literals;

constexpr RobotId kRobot{1};
constexpr uint16_t kNode = 1;

// The sensors for the ground of a Thymio are noisy wherever it is.
World made_with_chaos(std::vector<ChaosFault> faults = {}) {
    WorldDefinition definition;
    definition.width = 2;
    definition.height = 2;
    definition.robots.push_back({.name = "thymio", .at = {1, 1}});
    WorldOptions options;
    options.chaos.faults = std::move(faults);
    return make_world(definition, std::move(options));
}

std::string state_at(World& world, Time at) {
    world.step(at - world.now());
    return world.state_of(kRobot, kNode);
}

std::string after_reseed(uint64_t seed) {
    World world = made_with_chaos();
    world.step(500ms);
    world.reseed(seed);
    return state_at(world, 1s);
}

TEST(Reseed, TheSameSeedGivesTheSameBytesAndAnotherOneOthers) {
    EXPECT_EQ(after_reseed(5), after_reseed(5));
    EXPECT_NE(after_reseed(5), after_reseed(6));
    World as_it_was = made_with_chaos();
    EXPECT_NE(after_reseed(5), state_at(as_it_was, 1s));
}

TEST(Reseed, NothingChangesAtThatInstant) {
    World world = made_with_chaos();
    const std::string before = state_at(world, 500ms);
    world.reseed(5);
    EXPECT_EQ(world.state_of(kRobot, kNode), before);
    EXPECT_EQ(world.chaos_seed(), 5u);
}

TEST(Reseed, ResetUndoesIt) {
    World world = made_with_chaos({{.kind = ChaosKind::Lost, .where = "thymio-II", .chance = 0.5}});
    world.step(500ms);
    world.reseed(5);
    world.reset();
    EXPECT_EQ(world.chaos_seed(), 1u);
    World other = made_with_chaos({{.kind = ChaosKind::Lost, .where = "thymio-II", .chance = 0.5}});
    EXPECT_EQ(state_at(world, 1s), state_at(other, 1s));
}

// ---- faults ----

// How many of 100 user events the node has heard by each of them; half of the frames are lost.
std::vector<int16_t> heard(std::optional<uint64_t> seed) {
    World world = made_with_chaos({{.kind = ChaosKind::Lost, .where = "thymio-II", .chance = 0.5}});
    Host host(world.bus());
    std::vector<int16_t> counts;
    world.step(10ms);
    if (seed) world.reseed(*seed);
    for (int i = 0; i < 100; ++i) {
        host.set(kNode, 100, {static_cast<int16_t>(i)});
        world.step(10ms);
        counts.push_back(world.variables(kRobot)[100]);
    }
    return counts;
}

TEST(Reseed, FaultsThatActHitOtherFrames) {
    EXPECT_EQ(heard(5), heard(5));
    EXPECT_NE(heard(5), heard(6));
    EXPECT_NE(heard(5), heard(std::nullopt));
    EXPECT_EQ(heard(1), heard(std::nullopt));  // that of the world
}

TEST(Reseed, ANoisySensorIsNoisyOtherwise) {
    const auto read = [](uint64_t seed) {
        World world = made_with_chaos(
            {{.kind = ChaosKind::Noisy, .where = "thymio-II", .sensor = "temperature", .by = 100}});
        world.step(500ms);
        world.reseed(seed);
        return state_at(world, 2s);
    };
    EXPECT_EQ(read(5), read(5));
    EXPECT_NE(read(5), read(6));
}

// The link of a main computer: what becomes of a frame follows from the seed and the instant alone,
// so from a reseed on it is as if that had been the seed all the time.
TEST(Reseed, TheLinkOfAComputerIsReseededWithTheWorld) {
    const std::vector<ChaosFault> faults = {
        {.kind = ChaosKind::Lost, .where = "main", .chance = 0.5}};
    const auto pass = [](HostChaos& chaos, int from) {
        std::vector<bool> passed;
        for (int i = from; i < from + 100; ++i) {
            wire::Frame frame;
            chaos.to_bus().put(frame, i * 1ms);
            passed.push_back(chaos.to_bus().take(frame, i * 1ms));
        }
        return passed;
    };
    HostChaos first(faults, "main", 1), second(faults, "main", 2);
    for (HostChaos* const one : {&first, &second}) one->advance(0ms);
    const std::vector<bool> with_one = pass(first, 1);
    first.reseed(2);
    EXPECT_EQ(pass(first, 101), pass(second, 101));
    first.restart();
    first.advance(0ms);
    EXPECT_EQ(pass(first, 1), with_one);
}

}  // namespace
}  // namespace vagus::sim
