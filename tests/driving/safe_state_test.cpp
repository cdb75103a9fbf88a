// What Carbot's drive node does by itself when its script does not run, and when nobody gives a
// sign of life (docs/carbot.md). All times are simulated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "pilot.hpp"
#include "sim/test_host.hpp"

using namespace vagus;
using namespace std::chrono_literals;

namespace {

constexpr uint16_t kDrive = 1;
constexpr int16_t kForgotten = -1;
constexpr const char* kPath = "carbot.aesl";
constexpr int16_t kDriving = 1;  // motion.state

// 1 ms to the node, 20 ms of a control period.
constexpr Duration kCommandIsZero = 21ms;
// From 310 mm/s at 0.6 m/s^2, and a control period.
constexpr Duration kStandsWithin = 540ms;

sim::WorldDefinition hall() {
    sim::WorldDefinition world;
    world.width = 20;
    world.height = 4;
    world.robots.push_back({.name = "carbot", .type = sim::RobotType::Carbot, .at = {1, 2}});
    return world;
}

// The drive node's script, with one more thing that it does wrong when it is asked to.
std::string with_fault() {
    std::string text = text_of("carbot/carbot.aesl");
    const std::string handler = "onevent drive.place\n";
    text.insert(text.find(handler) + handler.size(), "\ti = 1 / event.args[0]\n");
    return text;
}

// A pilot whose robot drives at full speed with token 7, and a host that can stop its node.
class Rig {
public:
    Rig() : pilot(hall(), kPath, with_fault(), 1), host(pilot.world().bus()) {}

    void drive() {
        pilot.send("drive.forward", {7, 15000, 0, 310});
        pilot.keep_alive(7);
        pilot.step(2s);
        ASSERT_EQ(speed(), 310);
        ASSERT_EQ(pilot.count("drive.ended"), 0u);
    }
    int speed() const { return pilot.variable("wheel.front.speed"); }
    bool stands() const { return speed() == 0 && pilot.variable("wheel.rear.speed") == 0; }
    double x() const { return pilot.pose().at.x; }
    template <typename Command>
    void command() {
        host.command<Command>(kDrive);
    }
    // Where the handler of `tick` begins: a paused node stops there.
    uint16_t tick_handler() {
        (void)host.frames();
        command<wire::Pause>();
        pilot.step(30ms);
        std::optional<uint16_t> pc;
        for (const wire::Frame& frame : host.frames()) {
            wire::ExecutionStateChanged state;
            if (frame.source == kDrive && wire::decode_message(frame, state) == wire::Error::None &&
                (state.flags & wire::kFlagActive) != 0)
                pc = state.pc;
        }
        command<wire::Run>();
        pilot.step(30ms);
        EXPECT_TRUE(pc);
        return pc.value_or(0);
    }
    void set_breakpoint(uint16_t pc) {
        wire::BreakpointSet set{};
        set.dest = kDrive;
        set.pc = pc;
        host.send(set);
    }

    Pilot pilot;
    sim::Host host;
};

// ---- each way in which the script can be kept from running ----

struct Way {
    const char* name;
    void (*take)(Rig& rig);
    void (*run)(Rig& rig);  // lets it run again
    bool forgets;           // the script does not know any more whose command it was
};

void run(Rig& rig) {
    rig.command<wire::Run>();
}

const Way kWays[] = {
    {"Stop", [](Rig& rig) { rig.command<wire::Stop>(); }, run, false},
    {"Reset", [](Rig& rig) { rig.command<wire::Reset>(); }, run, true},
    {"Pause", [](Rig& rig) { rig.command<wire::Pause>(); }, run, false},
    {"Step",
     [](Rig& rig) {
         rig.command<wire::Pause>();
         for (int i = 0; i < 30; ++i) rig.command<wire::Step>();
     },
     run, false},
    {"DivisionByZero",
     [](Rig& rig) {
         rig.pilot.send("drive.place", {0, 0, 0, 0, 0});
     },
     run, false},
    {"NewBytecode", [](Rig& rig) { rig.pilot.reload(text_of("carbot/carbot.aesl")); }, [](Rig&) {},
     true},
    {"ErasedProgram", [](Rig& rig) { rig.host.load(kDrive, {0}); },
     [](Rig& rig) {
         std::string other = with_fault();
         other.insert(other.find("var i\n"), "var more\n");
         rig.pilot.reload(other);
     },
     true},
};

class SafeState : public testing::TestWithParam<Way> {};

std::string name_of(const testing::TestParamInfo<Way>& info) {
    return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Ways, SafeState, testing::ValuesIn(kWays), name_of);

TEST_P(SafeState, TheCommandEndsWithinAControlPeriodAndTheWheelsStandSoonAfter) {
    Rig rig;
    rig.drive();
    GetParam().take(rig);
    // A new program comes in several frames, each of which takes its time on the bus.
    for (Duration waited{}; rig.pilot.variable("motion.kind") != 0 && waited < 10ms; waited += 1ms)
        rig.pilot.step(1ms);
    rig.pilot.step(kCommandIsZero);
    EXPECT_EQ(rig.pilot.variable("motion.kind"), 0);
    EXPECT_NE(rig.pilot.variable("motion.state"), kDriving);
    EXPECT_LT(rig.speed(), 310) << "it brakes";
    rig.pilot.step(kStandsWithin - kCommandIsZero);
    EXPECT_TRUE(rig.stands());
    const double x = rig.x();
    rig.pilot.step(1s);
    EXPECT_NEAR(rig.x(), x, 1e-6);
}

TEST_P(SafeState, WhatWasCommandedBeforeIsNotResumedAndItsTokenIsTold) {
    Rig rig;
    rig.drive();
    GetParam().take(rig);
    rig.pilot.step(kStandsWithin);
    const double x = rig.x();
    GetParam().run(rig);
    rig.pilot.step(1s);
    EXPECT_NEAR(rig.x(), x, 1e-6) << "signs of life still come";
    EXPECT_GE(rig.pilot.count("drive.ended", {7}), 1u);
    EXPECT_EQ(rig.pilot.count("drive.arrived"), 0u);
    rig.pilot.send("drive.forward", {8, 300, 0, 200});
    rig.pilot.keep_alive(8);
    EXPECT_TRUE(rig.pilot.wait_for("drive.arrived", {8}, 4s));
    EXPECT_NEAR(rig.x(), x + 0.3, 0.01);
}

// So that also an actor that gives no signs of life, but commands again and again, is told.
TEST_P(SafeState, WhoseCommandHasEndedIsToldWithoutASignOfLife) {
    Rig rig;
    rig.drive();
    rig.pilot.fall_silent();
    GetParam().take(rig);
    rig.pilot.step(kStandsWithin);
    GetParam().run(rig);
    const int16_t token = GetParam().forgets ? kForgotten : int16_t{7};
    if (rig.pilot.count("drive.ended", {token}) == 0) {
        EXPECT_TRUE(rig.pilot.wait_for("drive.ended", {token}, 200ms));
    }
    rig.pilot.step(1s);
    EXPECT_EQ(rig.pilot.count("drive.ended"), 1u);
}

// ---- breakpoints, and pauses that pass no control step ----

TEST(SafeStates, ABreakpointBrakes) {
    Rig rig;
    const uint16_t pc = rig.tick_handler();
    rig.drive();
    rig.set_breakpoint(pc);
    rig.pilot.step(20ms + kCommandIsZero);  // until the next tick
    EXPECT_EQ(rig.pilot.variable("motion.kind"), 0);
    EXPECT_LT(rig.speed(), 310);
    rig.pilot.step(kStandsWithin);
    EXPECT_TRUE(rig.stands());
    const double x = rig.x();
    rig.command<wire::BreakpointClearAll>();
    run(rig);
    rig.pilot.step(1s);
    EXPECT_NEAR(rig.x(), x, 1e-6);
    EXPECT_GE(rig.pilot.count("drive.ended", {7}), 1u);
}

TEST(SafeStates, APauseShorterThanAControlStepChangesNothing) {
    Rig rig;
    rig.drive();
    rig.command<wire::Pause>();
    rig.pilot.step(5ms);
    run(rig);
    rig.pilot.step(1s);
    EXPECT_EQ(rig.speed(), 310);
    EXPECT_EQ(rig.pilot.count("drive.ended"), 0u);
}

TEST(SafeStates, APauseChangesNothingWhereTheClockStopsToo) {
    Rig rig;
    rig.drive();
    const double x = rig.x();
    rig.pilot.fall_silent();
    rig.command<wire::Pause>();
    for (int i = 0; i < 1000; ++i) rig.pilot.world().hold_instant();
    run(rig);
    for (int i = 0; i < 10; ++i) rig.pilot.world().hold_instant();
    EXPECT_EQ(rig.x(), x);
    rig.pilot.keep_alive(7);
    rig.pilot.step(1s);
    EXPECT_EQ(rig.speed(), 310);
    EXPECT_EQ(rig.pilot.count("drive.ended"), 0u);
}

// The host of such a world needs some time to notice that a node is paused.
TEST(SafeStates, APauseMayBeNoticedLateWhereTheClockStopsToo) {
    Rig rig;
    rig.pilot.world().stops_with_nodes();
    rig.drive();
    rig.command<wire::Pause>();
    rig.pilot.step(60ms);
    run(rig);
    rig.pilot.step(1s);
    EXPECT_EQ(rig.speed(), 310);
    EXPECT_EQ(rig.pilot.count("drive.ended"), 0u);
    rig.command<wire::Stop>();
    rig.pilot.step(kStandsWithin);
    EXPECT_TRUE(rig.stands()) << "a Stop is a Stop";
}

// ---- two things at a time ----

TEST(SafeStates, StopThenRunAtOnceEndsTheCommandAllTheSame) {
    Rig rig;
    rig.drive();
    rig.command<wire::Stop>();
    run(rig);
    rig.pilot.step(kStandsWithin);
    EXPECT_TRUE(rig.stands());
    EXPECT_GE(rig.pilot.count("drive.ended", {7}), 1u);
    const double x = rig.x();
    rig.pilot.step(1s);
    EXPECT_NEAR(rig.x(), x, 1e-6);
}

TEST(SafeStates, ACommandRightBehindStopAndRunIsObeyedAndTheOneBeforeIsTold) {
    Rig rig;
    rig.drive();
    rig.command<wire::Stop>();
    run(rig);
    rig.pilot.keep_alive(8);
    rig.pilot.send("drive.forward", {8, 500, 0, 200});
    EXPECT_TRUE(rig.pilot.wait_for("drive.arrived", {8}, 6s));
    EXPECT_EQ(rig.pilot.count("drive.ended", {7}), 1u);
    EXPECT_EQ(rig.pilot.count("drive.ended"), 1u);
}

TEST(SafeStates, AStopWhileItBrakesIsAnsweredAtTheNextRun) {
    Rig rig;
    rig.drive();
    rig.pilot.fall_silent();
    rig.pilot.send("drive.stop", {7});
    rig.pilot.step(50ms);
    ASSERT_FALSE(rig.stands());
    rig.command<wire::Stop>();
    rig.pilot.step(kStandsWithin);
    EXPECT_TRUE(rig.stands());
    EXPECT_EQ(rig.pilot.count("drive.stopped"), 0u);
    run(rig);
    EXPECT_TRUE(rig.pilot.wait_for("drive.stopped", {7}, 50ms));
}

TEST(SafeStates, StopDuringASilenceEndsTheCommandThatWasKept) {
    Rig rig;
    rig.drive();
    rig.pilot.fall_silent();
    rig.pilot.step(600ms);
    ASSERT_TRUE(rig.stands());
    rig.command<wire::Stop>();
    rig.pilot.step(100ms);
    run(rig);
    EXPECT_TRUE(rig.pilot.wait_for("drive.ended", {7}, 50ms));
    const double x = rig.x();
    rig.pilot.keep_alive(7);
    rig.pilot.step(1s);
    EXPECT_NEAR(rig.x(), x, 1e-6);
}

// It has arrived while its script did not run: that is told all the same.
TEST(SafeStates, AnArrivalDuringAShortPauseIsToldAfterIt) {
    Rig rig;
    rig.pilot.world().stops_with_nodes();
    rig.pilot.send("drive.forward", {7, 300, 0, 310});
    rig.pilot.keep_alive(7);
    rig.pilot.step(500ms);
    while (rig.pilot.variable("motion.left") > 1) rig.pilot.step(1ms);
    rig.command<wire::Pause>();
    rig.pilot.step(500ms);
    ASSERT_TRUE(rig.stands());
    EXPECT_EQ(rig.pilot.count("drive.arrived"), 0u);
    run(rig);
    EXPECT_TRUE(rig.pilot.wait_for("drive.arrived", {7}, 50ms));
}

// ---- a driver that falls silent ----

TEST(SafeStates, SilenceBrakesInTimeAndAfterThreeSecondsTheCommandIsOver) {
    Rig rig;
    rig.drive();
    while (rig.pilot.now() % 100ms != Duration::zero()) rig.pilot.step(1ms);
    rig.pilot.step(1ms);  // the last one is sent now
    rig.pilot.fall_silent();
    const Time last = rig.pilot.now();
    while (rig.speed() == 310) rig.pilot.step(1ms);
    EXPECT_LE(rig.pilot.now() - last, 350ms);
    while (!rig.stands()) rig.pilot.step(1ms);
    EXPECT_LE(rig.pilot.now() - last, 900ms);
    rig.pilot.step(last + 2900ms - rig.pilot.now());
    EXPECT_EQ(rig.pilot.count("drive.ended"), 0u);
    EXPECT_TRUE(rig.pilot.wait_for("drive.ended", {7}, 200ms));
    // Signs of life do not resume it, and are answered.
    const double x = rig.x();
    rig.pilot.keep_alive(7);
    rig.pilot.step(1s);
    EXPECT_NEAR(rig.x(), x, 1e-6);
    EXPECT_GE(rig.pilot.count("drive.ended", {7}), 5u);
    // Given again, it is obeyed, by the same token too.
    rig.pilot.send("drive.forward", {7, 300, 0, 200});
    EXPECT_TRUE(rig.pilot.wait_for("drive.arrived", {7}, 4s));
    EXPECT_NEAR(rig.x(), x + 0.3, 0.01);
}

TEST(SafeStates, ASilenceOfLessThanThreeSecondsIsResumed) {
    Rig rig;
    rig.drive();
    rig.pilot.fall_silent();
    rig.pilot.step(2800ms);
    ASSERT_TRUE(rig.stands());
    rig.pilot.keep_alive(7);
    rig.pilot.step(1s);
    EXPECT_EQ(rig.speed(), 310);
    EXPECT_EQ(rig.pilot.count("drive.ended"), 0u);
}

TEST(SafeStates, WhoseWheelsAnotherTokenTookIsTold) {
    Rig rig;
    rig.drive();
    rig.pilot.send("drive.forward", {8, 5000, 0, 310});
    EXPECT_TRUE(rig.pilot.wait_for("drive.ended", {7}, 150ms));
    EXPECT_EQ(rig.speed(), 310) << "the other one drives on";
}

// ---- the rotator of the distance sensor ----

TEST(SafeStates, TheRotatorStopsWhereItIsAndItsWorkGoesOnAfterRun) {
    Rig rig;
    constexpr uint16_t kRange = 3;
    rig.pilot.send("range.look", {9, 1200});
    rig.pilot.step(100ms);
    ASSERT_GT(rig.pilot.variable("rotator.angle"), 100);
    rig.host.command<wire::Stop>(kRange);
    rig.pilot.step(kCommandIsZero);
    const int16_t angle = rig.pilot.variable("rotator.angle");
    ASSERT_LT(angle, 1200);
    rig.pilot.step(1s);
    EXPECT_EQ(rig.pilot.variable("rotator.angle"), angle);
    rig.host.command<wire::Run>(kRange);
    rig.pilot.step(1s);
    EXPECT_EQ(rig.pilot.variable("rotator.angle"), 1200);
    EXPECT_EQ(rig.pilot.count("range.measured"), 1u);
    EXPECT_EQ(rig.pilot.count("range.ended"), 0u);
}

TEST(SafeStates, ALookThatAResetHasMadeTheScriptForgetIsToldAsEnded) {
    Rig rig;
    constexpr uint16_t kRange = 3;
    rig.pilot.send("range.look", {9, 1200});
    rig.pilot.step(100ms);
    rig.host.command<wire::Reset>(kRange);
    rig.pilot.step(100ms);
    rig.host.command<wire::Run>(kRange);
    EXPECT_TRUE(rig.pilot.wait_for("range.ended", {kForgotten}, 50ms));
}

}  // namespace
