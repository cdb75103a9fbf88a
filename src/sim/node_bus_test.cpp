#include <gtest/gtest.h>

#include "sim/node_bus.hpp"
#include "sim/test_host.hpp"
#include "sim/world.hpp"
#include "wire/messages.hpp"

using namespace vagus;
using namespace vagus::sim;
using namespace std::chrono_literals;

namespace {

WorldOptions can() {
    WorldOptions options;
    options.bus = BusModel::Can;
    return options;
}

WorldDefinition with_thymios(std::vector<uint16_t> nodes) {
    WorldDefinition world;
    world.width = world.height = 2;
    for (const uint16_t node : nodes) {
        const double x = 0.3 * static_cast<double>(world.robots.size() + 1);
        world.robots.push_back({.name = "t" + std::to_string(node), .at = {x, 1}, .node = node});
    }
    return world;
}

wire::Frame event_of_zeros(uint16_t source) {
    wire::Frame frame{};
    frame.source = source;
    frame.size = 6;
    return frame;
}

// A host on the bus.
class BusHost {
public:
    explicit BusHost(World& world) : hub_(world.bus()), link_(hub_.add({.name = "host"}).value()) {}

    void send(const wire::Frame& frame) { hub_.receive(link_, frame); }
    void list_nodes() {
        wire::ListNodes message{};
        message.version = wire::kProtocolVersion;
        wire::Frame frame;
        ASSERT_EQ(wire::encode_message(message, wire::kHostId, frame), wire::Error::None);
        send(frame);
    }
    std::vector<wire::Frame> frames() {
        std::vector<wire::Frame> all;
        wire::Frame frame;
        while (hub_.take(link_, frame)) all.push_back(frame);
        return all;
    }

private:
    hub::Hub& hub_;
    hub::LinkId link_;
};

// The question leaves at 0, takes below 150 microseconds and arrives at 1 ms; the answers leave
// then and arrive at 2 ms, the lower identifier first.
TEST(NodeBus, AFrameArrivesAtTheMillisecondAfterItsTransmission) {
    World world = make_world(with_thymios({7, 3}), can());
    BusHost host(world);
    host.list_nodes();
    world.step(1ms);
    EXPECT_TRUE(host.frames().empty());
    world.step(1ms);
    const std::vector<wire::Frame> answers = host.frames();
    ASSERT_EQ(answers.size(), 2u);
    EXPECT_EQ(answers[0].source, 3);
    EXPECT_EQ(answers[1].source, 7);
}

// 20 events a millisecond, more than the bus carries, under the lowest id: it wins the bus from
// every node.
TEST(NodeBus, AFloodUnderAnotherNodesIdKeepsNeitherStopNorItsAnswerAway) {
    World world = make_world(with_thymios({3, 7}), can());
    BusHost host(world);
    BusHost flood(world);
    const auto flood_for = [&](int milliseconds) {
        for (int i = 0; i < milliseconds; ++i) {
            for (int k = 0; k < 20; ++k) flood.send(event_of_zeros(1));
            world.step(1ms);
        }
    };
    flood_for(500);
    (void)host.frames();
    for (const uint16_t node : {uint16_t{3}, uint16_t{7}}) {
        wire::Stop stop{};
        stop.dest = node;
        wire::Frame frame;
        ASSERT_EQ(wire::encode_message(stop, wire::kHostId, frame), wire::Error::None);
        host.send(frame);
    }
    flood_for(20);
    std::vector<uint16_t> stopped;
    for (const wire::Frame& frame : host.frames()) {
        const auto type = static_cast<wire::MessageType>(frame.type);
        if (type == wire::MessageType::ExecutionStateChanged) stopped.push_back(frame.source);
    }
    EXPECT_EQ(stopped, (std::vector<uint16_t>{3, 7}));
}

TEST(NodeBus, AnIdealBusAnswersAtOnceAndCountsNothing) {
    World world = make_world(with_thymios({7, 3}), {});
    BusHost host(world);
    host.list_nodes();
    world.step(1ms);
    EXPECT_EQ(host.frames().size(), 2u);
    EXPECT_FALSE(world.bus_load());
}

TEST(NodeBus, HostsHearEachOtherAndWhatTheyHearIsCountedOnce) {
    World world = make_world(with_thymios({1}), can());
    BusHost one(world);
    BusHost two(world);
    one.send(event_of_zeros(0));
    EXPECT_EQ(two.frames().size(), 1u);  // the hub's business, not the bus's
    world.step(1ms);
    EXPECT_TRUE(one.frames().empty());
    const BusLoad load = *world.bus_load();
    ASSERT_EQ(load.nodes.size(), 2u);
    EXPECT_EQ(load.nodes[0].load.name, "main");
    EXPECT_EQ(load.nodes[0].load.frames, 1u);
    EXPECT_EQ(load.nodes[1].node, 1);
    EXPECT_EQ(load.nodes[1].load.name, "thymio-II");
    EXPECT_EQ(load.nodes[1].load.frames, 0u);
    EXPECT_EQ(load.all.frames, 1u);
}

TEST(NodeBus, NodesOfSeveralRobotsAreToldApartByTheirRobot) {
    World world = make_world(with_thymios({1, 2}), can());
    EXPECT_EQ(world.bus_load()->nodes[2].load.name, "t2/thymio-II");
}

// 2000 frames at once are more than a port holds: they wait in the hub and pass as fast as the bus
// goes, one after the other.
TEST(NodeBus, AFloodFromAHostWaitsForTheBusAndLosesNothing) {
    World world = make_world(with_thymios({1}), can());
    BusHost host(world);
    for (int i = 0; i < 2000; ++i) host.send(event_of_zeros(0));
    world.step(10ms);
    // Not as many as fit: the rest of each millisecond is for nodes.
    EXPECT_EQ(world.bus_load()->all.frames, size_t{10} * kCanAheadInCrowd);
    world.step(400ms);
    EXPECT_EQ(world.bus_load()->all.frames, 2000u);
    EXPECT_EQ(world.bus_load()->all.dropped, 0u);
    EXPECT_LE(world.bus_load()->nodes[0].load.waiting_most, kCanQueueMax);
}

TEST(NodeBus, AFrameThatFitsNoIdentifierIsCountedAsDropped) {
    World world = make_world(with_thymios({1}), can());
    BusHost host(world);
    host.send(event_of_zeros(256));
    world.step(1ms);
    EXPECT_EQ(world.bus_load()->nodes[0].load.dropped, 1u);
}

TEST(NodeBus, ANodeIdBeyondEightBitsIsRefused) {
    EXPECT_TRUE(World::create(with_thymios({255}), can()).ok());
    const Result<World> refused = World::create(with_thymios({256}), can());
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().what,
              "robots[0].node: expected ids up to 255, for a CAN bus carries no others; found 256; "
              "give robot t256 a smaller one");
    EXPECT_TRUE(World::create(with_thymios({256}), {}).ok());
}

// While the world is held, scripts are loaded: no time passes, and nothing is counted.
TEST(NodeBus, WhileTheWorldStandsStillFramesPassAtOnceAndUncounted) {
    World world = make_world(with_thymios({1, 2}), can());
    BusHost host(world);
    host.list_nodes();
    world.hold_instant();
    EXPECT_EQ(host.frames().size(), 2u);
    EXPECT_EQ(world.now(), 0ms);
    EXPECT_EQ(world.bus_load()->all.frames, 0u);
}

TEST(NodeBus, AResetForgetsWhatWasUnderWay) {
    World world = make_world(with_thymios({1}), can());
    BusHost host(world);
    world.step(5ms);
    host.list_nodes();
    world.reset();
    world.step(5ms);
    EXPECT_TRUE(host.frames().empty());
    EXPECT_EQ(world.bus_load()->all.frames, 0u);
    host.list_nodes();
    world.step(2ms);
    EXPECT_EQ(host.frames().size(), 1u);
}

}  // namespace
