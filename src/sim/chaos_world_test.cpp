// What faults do to the nodes of a world. Times and values are worked out by hand from the rates of
// docs/sensors.md and the sentences of docs/testing.md, "Chaos".
#include <gtest/gtest.h>

#include <set>

#include "sim/test_host.hpp"
#include "sim/world.hpp"
#include "wire/messages.hpp"

namespace vagus::sim {
namespace {

using namespace std::chrono_literals;

constexpr uint16_t kCounter = 100;  // address of the variable that counts
constexpr uint16_t kEvent = 0;

// Counts user event 0 in kCounter; its init event writes 7 to the next variable.
const std::vector<uint16_t> kCounting = {5,
                                         0xffff,
                                         5,
                                         kEvent,
                                         8,  // the events
                                         0x1007,
                                         static_cast<uint16_t>(0x4000 | (kCounter + 1)),
                                         0x0000,  // init
                                         static_cast<uint16_t>(0x3000 | kCounter),
                                         0x1001,
                                         0x8002,  // add 1
                                         static_cast<uint16_t>(0x4000 | kCounter),
                                         0x0000};

WorldDefinition in_chaos() {
    WorldDefinition world;
    world.width = 4;
    world.height = 2;
    world.robots.push_back({.name = "thymio", .at = {1, 1}});
    return world;
}

World made_with(const WorldDefinition& definition, std::vector<ChaosFault> faults,
                WorldOptions options = {}) {
    options.chaos.faults = std::move(faults);
    return make_world(definition, std::move(options));
}

// A Thymio that counts, and a host that sends it an event each 10 ms, the first at 10 ms.
class Rig {
public:
    explicit Rig(std::vector<ChaosFault> faults, WorldOptions options = {})
        : world(made_with(in_chaos(), std::move(faults), options)), host(world.bus()) {
        host.load(1, kCounting);
        for (int i = 0; i < 3; ++i) world.hold_instant();
    }
    // Whole steps of 10 ms: what is sent at the end of one is delivered within the next.
    void pass(Duration span) {
        for (Duration passed{}; passed < span; passed += 10ms) {
            wire::Frame frame{};
            frame.type = kEvent;
            world.step(9ms);
            collect();
            send(frame);
            world.step(1ms);
            collect();
        }
    }
    void send(const wire::Frame& frame) { events_.receive(frame); }
    int counted() const { return word(kCounter); }
    int word(uint16_t address) const { return world.variables(RobotId{1})[address]; }
    void collect() {
        for (const Happening& one : world.happenings()) {
            const auto* const note = std::get_if<ChaosNote>(&one.what);
            if (note != nullptr) told.emplace_back(one.at, note->what);
        }
    }

    World world;
    Host host;
    std::vector<std::pair<Time, std::string>> told;

private:
    // Another host, for frames that are no messages.
    struct Events {
        explicit Events(hub::Hub& its_bus)
            : bus(its_bus), link(its_bus.add({.name = "events"}).value()) {}
        void receive(const wire::Frame& frame) { bus.receive(link, frame); }
        hub::Hub& bus;
        hub::LinkId link;
    };
    Events events_{world.bus()};
};

ChaosFault of(ChaosKind kind, Time from, std::optional<Time> until = {}) {
    return {.kind = kind, .where = "thymio-II", .from = from, .until = until};
}

TEST(ChaosWorlds, WithoutFaultsCountEachEvent) {
    Rig rig({});
    rig.pass(1s);
    EXPECT_EQ(rig.counted(), 100);
    EXPECT_TRUE(rig.told.empty());
}

// Of 100 events those at 210 to 400 ms do not arrive.
TEST(ChaosWorlds, AnUnpluggedNodeHearsNothingUntilItIsBack) {
    Rig rig({of(ChaosKind::Unplugged, 205ms, 405ms)});
    rig.pass(1s);
    EXPECT_EQ(rig.counted(), 80);
    const std::vector<std::pair<Time, std::string>> expected = {
        {205ms, "thymio-II is unplugged"}, {405ms, "thymio-II is plugged in again"}};
    EXPECT_EQ(rig.told, expected);
}

TEST(ChaosWorlds, FramesAreLostAndDoubled) {
    Rig lost({of(ChaosKind::Lost, 205ms, 405ms)});
    lost.pass(1s);
    EXPECT_EQ(lost.counted(), 80);
    Rig doubled({of(ChaosKind::Doubled, 205ms, 405ms)});
    doubled.pass(1s);
    EXPECT_EQ(doubled.counted(), 120);
}

// From 205 ms on they take 300 ms longer: at 505 ms 20 of them have arrived, at 1 s 70.
TEST(ChaosWorlds, FramesAreLate) {
    ChaosFault late = of(ChaosKind::Delayed, 205ms);
    late.by = 0.3;
    Rig rig({late});
    rig.pass(500ms);
    EXPECT_EQ(rig.counted(), 20);
    rig.pass(500ms);
    EXPECT_EQ(rig.counted(), 70);
}

TEST(ChaosWorlds, ACanBusHasTheSameFaults) {
    Rig rig({of(ChaosKind::Unplugged, 205ms, 405ms)}, {.bus = BusModel::Can});
    rig.pass(1s);
    EXPECT_GE(rig.counted(), 79);  // the last is still on its way
    EXPECT_LE(rig.counted(), 80);
}

// What the node says is lost, too.
TEST(ChaosWorlds, AnUnpluggedNodeIsNotHeard) {
    Rig rig({of(ChaosKind::Unplugged, 105ms, 205ms)});
    const auto answers = [&rig] {
        (void)rig.host.frames();
        wire::GetExecutionState ask{};
        ask.dest = 1;
        rig.host.send(ask);
        rig.world.step(5ms);
        return rig.host.frames().size();
    };
    rig.pass(100ms);
    EXPECT_EQ(answers(), 1u);
    rig.world.step(5ms);
    EXPECT_EQ(answers(), 0u);
    rig.world.step(100ms);
    EXPECT_EQ(answers(), 1u);
}

// It counts from 0 again, for its program was saved; and its init event runs.
TEST(ChaosWorlds, AResetNodeBeginsAgainWithItsProgram) {
    Rig rig({of(ChaosKind::Reset, 505ms)});
    rig.host.set(1, kCounter + 1, {0});
    rig.pass(500ms);
    EXPECT_EQ(rig.counted(), 50);
    EXPECT_EQ(rig.word(kCounter + 1), 0);
    rig.pass(500ms);
    EXPECT_EQ(rig.counted(), 50);
    EXPECT_EQ(rig.word(kCounter + 1), 7);
    EXPECT_EQ(rig.word(0), 1);  // _id, as it was made
}

// It hears nothing from 505 ms on; at 605 ms its watchdog resets it, and the 40 of 610 ms to 1 s
// arrive.
TEST(ChaosWorlds, AHungNodeIsResetByItsWatchdog) {
    Rig rig({of(ChaosKind::Hung, 505ms)});
    rig.pass(600ms);
    EXPECT_EQ(rig.counted(), 50);
    rig.pass(400ms);
    EXPECT_EQ(rig.counted(), 40);
    ASSERT_EQ(rig.told.size(), 2u);
    EXPECT_EQ(rig.told[1].first, 605ms);
    EXPECT_EQ(rig.told[1].second, "the watchdog of thymio-II resets it");
}

uint16_t address_of(std::string_view name) {
    uint16_t address = 0;
    for (const auto& [variable, words] :
         std::initializer_list<std::pair<const char*, int>>{{"_id", 1},
                                                            {"event.source", 1},
                                                            {"event.args", 32},
                                                            {"_productId", 1},
                                                            {"_fwversion", 2},
                                                            {"button", 5},
                                                            {"prox.horizontal", 7},
                                                            {"prox.comm.rx", 1},
                                                            {"prox.comm.tx", 1},
                                                            {"prox.ground", 6},
                                                            {"motor.left.target", 1},
                                                            {"motor.right.target", 1}}) {
        if (name == variable) return address;
        address = static_cast<uint16_t>(address + words);
    }
    return address;
}

// A Thymio keeps its targets while its program hangs; a reset ends them.
TEST(ChaosWorlds, TheMotorsOfAThymioEndWithItsReset) {
    Rig rig({of(ChaosKind::Hung, 1005ms)});
    rig.host.set(1, address_of("motor.left.target"), {300, 300});
    rig.pass(1s);
    const auto x = [&rig] { return rig.world.robots()[0].pose.at.x; };
    double before = x();
    rig.pass(90ms);
    EXPECT_GT(x(), before + 0.005);  // 90 ms at 10 cm/s
    rig.pass(510ms);
    before = x();
    rig.pass(500ms);
    EXPECT_NEAR(x(), before, 1e-6);
    EXPECT_EQ(rig.word(address_of("motor.left.target")), 0);
}

// The cable of one that runs its own script is pulled: it drives on, and what stops it arrives when
// frames pass again.
TEST(ChaosWorlds, AThymioWithoutSignsOfLifeStopsWhenFramesPassAgain) {
    Rig rig({of(ChaosKind::Unplugged, 505ms, 1505ms)});
    rig.host.set(1, address_of("motor.left.target"), {300, 300});
    rig.pass(600ms);
    const auto make_safe = [&rig] {
        rig.host.command<wire::Stop>(1);
        rig.host.set(1, address_of("motor.left.target"), {0, 0});
    };
    make_safe();
    rig.pass(900ms);
    EXPECT_EQ(rig.word(address_of("motor.left.target")), 300);
    rig.pass(10ms);
    make_safe();
    rig.pass(900ms);
    const double before = rig.world.robots()[0].pose.at.x;
    rig.pass(500ms);
    EXPECT_NEAR(rig.world.robots()[0].pose.at.x, before, 1e-6);
}

// ---- sensors ----

// A wall 10 cm before the middle of the Thymio is put there at 500 ms: its front sensor reads about
// 4265 (robots_test.cpp), and 0 before.
class SensorRig {
public:
    explicit SensorRig(ChaosFault fault) : world(made_with(definition(), {std::move(fault)})) {}
    static WorldDefinition definition() {
        WorldDefinition world = in_chaos();
        world.timeline.push_back({500ms, AddObject{{.id = "wall",
                                                    .kind = ObjectKind::Wall,
                                                    .at = {1.105, 1},
                                                    .width = 0.01,
                                                    .length = 0.44}}});
        return world;
    }
    int front_at(Time at) {
        world.step(at - world.now());
        return world.variables(RobotId{1})[address_of("prox.horizontal") + 2];
    }
    World world;
};

ChaosFault of_prox(ChaosKind kind, double by = 0) {
    ChaosFault fault = of(kind, 300ms, 800ms);
    fault.sensor = "prox.horizontal";
    fault.by = by;
    return fault;
}

TEST(ChaosSensorsOfWorlds, AreStuckDeadAndBack) {
    SensorRig stuck(of_prox(ChaosKind::Stuck));
    EXPECT_EQ(stuck.front_at(790ms), 0);
    EXPECT_NEAR(stuck.front_at(1s), 4265, 80);
    SensorRig later([] {
        ChaosFault fault = of_prox(ChaosKind::Stuck);
        fault.from = 700ms;
        return fault;
    }());
    const int held = later.front_at(710ms);
    EXPECT_NEAR(held, 4265, 80);
    EXPECT_EQ(later.front_at(799ms), held);
    SensorRig dead(of_prox(ChaosKind::Dead));
    EXPECT_EQ(dead.front_at(790ms), 0);
    EXPECT_NEAR(dead.front_at(800ms), 4265, 80);  // at once, as it was sensed
}

// Ten samples of standard deviation 300; that of all being within 80 of the true value is less
// likely than 1e-6 (0.21 to the tenth power).
TEST(ChaosSensorsOfWorlds, AreNoisy) {
    SensorRig rig(of_prox(ChaosKind::Noisy, 300));
    int apart = 0;
    std::vector<int> read;
    for (Time at = 610ms; at < 800ms; at += 100ms) read.push_back(rig.front_at(at));
    for (const int value : read) apart = std::max(apart, std::abs(value - 4265));
    EXPECT_GT(apart, 80);
    EXPECT_LT(apart, 80 + 4 * 300);
    EXPECT_NEAR(rig.front_at(1s), 4265, 80);
}

// ---- the world ----

TEST(ChaosWorlds, NamesThatAreNotThereAreErrorsWithTheirPlace) {
    const auto error = [](ChaosFault fault) {
        WorldOptions options;
        options.chaos = {.file = "a.json", .faults = {std::move(fault)}};
        const auto world = World::create(in_chaos(), options);
        return world.ok() ? "" : world.error().what;
    };
    ChaosFault fault = of(ChaosKind::Reset, 1s);
    fault.place = {3, 5};
    fault.where = "thymio-I";
    EXPECT_EQ(error(fault),
              "a.json:3:5: the world has no node \"thymio-I\"; did you mean thymio-II?");
    fault.where = "thymio/thymio-II";
    EXPECT_EQ(error(fault), "");
    fault.where = "main";  // a computer is not reset
    EXPECT_NE(error(fault), "");
    fault.kind = ChaosKind::Lost;
    EXPECT_EQ(error(fault), "");
    fault = of(ChaosKind::Dead, 1s);
    fault.sensor = "prox.horizonal";
    EXPECT_TRUE(error(fault).starts_with(
        "a.json: the node \"thymio-II\" has no sensor \"prox.horizonal\";"))
        << error(fault);
    fault.sensor = "motor.left.target";
    EXPECT_NE(error(fault), "");
}

// A fault that changes nothing yet, and one at another robot.
TEST(ChaosWorlds, NodesWithoutFaultsRunToTheByteAsBefore) {
    WorldDefinition two = in_chaos();
    two.robots.push_back({.name = "other", .at = {3, 1}, .node = 2});
    const auto state_after = [&two](std::vector<ChaosFault> faults, unsigned threads) {
        World world = made_with(two, std::move(faults), {.threads = threads});
        Host host(world.bus());
        host.load(1, counting({0, 5, 9}));
        host.load(2, counting({0, 5, 9}));
        world.step(3s);
        return world.state_of(RobotId{1}, 1);
    };
    const std::string before = state_after({}, 1);
    ChaosFault late{.kind = ChaosKind::Delayed, .where = "thymio/thymio-II", .from = 10s, .by = 1};
    EXPECT_EQ(state_after({late}, 1), before);
    ChaosFault awake{.kind = ChaosKind::Doubled, .where = "thymio/thymio-II", .from = 1s};
    EXPECT_EQ(state_after({awake}, 1), before);  // it has its turn each millisecond
    ChaosFault other{.kind = ChaosKind::Hung, .where = "other/thymio-II", .from = 1s};
    EXPECT_EQ(state_after({other}, 1), before);
    EXPECT_EQ(state_after({other}, 2), before);
}

TEST(ChaosWorlds, TheSameFaultsGiveTheSameBytesAgain) {
    ChaosFault lost = of(ChaosKind::Lost, 100ms, 900ms);
    lost.chance = 0.5;
    const auto counted = [&lost](uint64_t seed) {
        Rig rig({lost}, {.seed = seed});
        rig.pass(1s);
        return rig.counted();
    };
    EXPECT_EQ(counted(1), counted(1));
    EXPECT_LT(counted(1), 90);
    std::set<int> counts;
    for (uint64_t seed = 1; seed <= 10; ++seed) counts.insert(counted(seed));
    EXPECT_GT(counts.size(), 1u);  // the seed of the world draws others
}

TEST(ChaosWorlds, AResetWorldHasItsFaultsAgain) {
    Rig rig({of(ChaosKind::Reset, 505ms)});
    rig.pass(1s);
    rig.world.reset();
    rig.told.clear();
    rig.pass(1s);
    ASSERT_EQ(rig.told.size(), 1u);
    EXPECT_EQ(rig.told[0].first, 505ms);
}

TEST(ChaosWorlds, DrawTheirFaultsFromWhatTheyHave) {
    Result<World> world = World::create(in_chaos(), {.chaos = {.draw = ChaosDraw{.count = 10}}});
    ASSERT_TRUE(world.ok()) << world.error().what;
    EXPECT_EQ(world.value().chaos().size(), 10u);
    const auto targets = world.value().chaos_targets();
    ASSERT_EQ(targets.size(), 1u);
    EXPECT_EQ(targets[0].node, "thymio-II");
    EXPECT_NE(std::ranges::find(targets[0].sensors, "prox.horizontal"), targets[0].sensors.end());
}

}  // namespace
}  // namespace vagus::sim
