#include "session/brake.hpp"

#include <gtest/gtest.h>

#include "debug/scripted_bus.hpp"

namespace vagus::session {
namespace {

using Nodes = std::vector<debug::NodeId>;
using Type = wire::MessageType;

constexpr debug::NodeId kDriveNode = 1, kBumperNode = 2, kArmNode = 3;
constexpr uint16_t kRunning = 0;
constexpr uint16_t kPaused = wire::kFlagStep | wire::kFlagActive;
constexpr uint16_t kAtBreakpoint = kPaused | wire::kFlagRunning;

// "drive" is named by the safe stop, "arm" has an event `halted`, "bumper" only senses.
class Braking : public testing::Test {
protected:
    void SetUp() override {
        describe(kDriveNode, "drive", "tick", "id");
        describe(kBumperNode, "bumper", "tick", "_program");
        describe(kArmNode, "arm", "halted", "_program");
        for (const debug::NodeId id : {kDriveNode, kBumperNode, kArmNode})
            bus_.state(id, 0, kRunning);
        bus_.forget();
        brake_.begin(bus_.network);
    }
    void describe(debug::NodeId id, const std::string& name, const std::string& event,
                  const std::string& variable) {
        wire::NodePresent present{};
        present.version = 5;
        bus_.node_sends(id, present);
        wire::Description header{};
        header.name = {name.data(), static_cast<uint8_t>(name.size())};
        header.protocol_version = 5;
        header.bytecode_size = 100;
        header.stack_size = 32;
        header.variables_size = 100;
        header.variable_count = 2;
        header.local_event_count = 1;
        bus_.node_sends(id, header);
        bus_.variable(id, "target", 1);
        bus_.variable(id, variable, variable == "_program" ? 2 : 1);
        wire::LocalEventDescription local{};
        local.name = {event.data(), static_cast<uint8_t>(event.size())};
        bus_.node_sends(id, local);
    }
    // Orders of all that happened since.
    Brake::Orders orders() {
        Brake::Orders all;
        bus_.pass({});
        for (const debug::Event& event : std::exchange(bus_.events, {})) {
            const auto one = brake_.hear(bus_.network, safe_, event);
            if (one.cause) all.cause = one.cause;
            all.pause.insert(all.pause.end(), one.pause.begin(), one.pause.end());
            all.make_safe.insert(all.make_safe.end(), one.make_safe.begin(), one.make_safe.end());
            all.run.insert(all.run.end(), one.run.begin(), one.run.end());
        }
        return all;
    }
    Brake::Orders after(debug::NodeId id, uint16_t flags) {
        bus_.state(id, 3, flags);
        return orders();
    }
    const debug::NodeView& view(debug::NodeId id) { return *bus_.network.node(id); }

    debug::ScriptedBus bus_;
    const SafeStop safe_ = {{"drive", {.set = {{"target", {0, 7}}}, .read = {}}}};
    Brake brake_;
};

TEST_F(Braking, WhatTheSafeStopNamesAndWhatHaltsItselfMoves) {
    EXPECT_TRUE(moves(view(kDriveNode), safe_));
    EXPECT_TRUE(moves(view(kArmNode), safe_));
    EXPECT_FALSE(moves(view(kBumperNode), safe_));
}

TEST_F(Braking, OneThatNothingCanBeReadOfIsNotKnownToBeAtRestWhileItRuns) {
    EXPECT_FALSE(may_move_unread(view(kDriveNode), safe_));  // what is set there can be read
    EXPECT_TRUE(may_move_unread(view(kDriveNode), {}));      // of whom nobody knows what it does
    EXPECT_TRUE(may_move_unread(view(kArmNode), safe_));
    EXPECT_FALSE(may_move_unread(view(kBumperNode), safe_));  // a node of Vagus that only senses
    bus_.state(kArmNode, 0, kPaused);
    EXPECT_FALSE(may_move_unread(view(kArmNode), safe_));
}

TEST_F(Braking, ThePauseOfASensorPausesWhatMovesUntilItRunsAgain) {
    const auto paused = after(kBumperNode, kPaused);
    EXPECT_EQ(paused.cause, kBumperNode);
    EXPECT_EQ(paused.pause, (Nodes{kDriveNode, kArmNode}));
    EXPECT_EQ(paused.make_safe, (Nodes{kDriveNode, kArmNode}));
    // That they are paused then is what was asked for.
    EXPECT_EQ(after(kDriveNode, kPaused).cause, std::nullopt);
    EXPECT_EQ(after(kArmNode, kPaused).cause, std::nullopt);
    EXPECT_EQ(brake_.braked(), (std::set<debug::NodeId>{kDriveNode, kArmNode}));
    EXPECT_EQ(after(kBumperNode, kRunning).run, (Nodes{kDriveNode, kArmNode}));
    EXPECT_TRUE(brake_.braked().empty());
}

TEST_F(Braking, OneThatMovesAndIsPausedByOthersIsMadeSafeAndNotLetRun) {
    const auto orders = after(kDriveNode, kPaused);
    EXPECT_EQ(orders.pause, Nodes{kArmNode});
    EXPECT_EQ(orders.make_safe, (Nodes{kArmNode, kDriveNode}));
    after(kArmNode, kPaused);
    after(kBumperNode, kPaused);
    EXPECT_EQ(after(kBumperNode, kRunning).run, Nodes{});  // drive is still missing
    EXPECT_EQ(after(kDriveNode, kRunning).run, Nodes{kArmNode});
}

TEST_F(Braking, AFaultAndALossBrake) {
    wire::DivisionByZero fault{};
    fault.pc = 5;
    bus_.node_sends(kBumperNode, fault);
    EXPECT_EQ(orders().pause, (Nodes{kDriveNode, kArmNode}));
    after(kBumperNode, kRunning);
    bus_.node_sends(kBumperNode, wire::Disconnected{});
    EXPECT_EQ(orders().cause, kBumperNode);
    EXPECT_FALSE(brake_.at_breakpoint());
}

TEST_F(Braking, ABreakpointIsKnownAsSuch) {
    after(kBumperNode, kAtBreakpoint);
    EXPECT_TRUE(brake_.at_breakpoint());
    after(kBumperNode, kRunning);
    EXPECT_FALSE(brake_.at_breakpoint());
}

TEST_F(Braking, WhoeverLetsOneRunMeanwhileIsObeyed) {
    after(kBumperNode, kPaused);
    after(kDriveNode, kPaused);
    after(kArmNode, kPaused);
    EXPECT_EQ(after(kDriveNode, kRunning).cause, std::nullopt);
    EXPECT_EQ(after(kBumperNode, kRunning).run, Nodes{kArmNode});
}

TEST_F(Braking, ANodeThatNeverRanIsNotMissed) {
    bus_.state(kBumperNode, 0, kPaused);
    orders();
    brake_.begin(bus_.network);
    EXPECT_EQ(after(kBumperNode, kAtBreakpoint).cause, std::nullopt);
}

TEST_F(Braking, WhatIsSafeIsWrittenAsFarAsTheVariableGoes) {
    make_safe(bus_.network, safe_, kDriveNode);
    make_safe(bus_.network, safe_, kArmNode);
    // SetVariables to node 1 from address 0: one word, 0.
    EXPECT_EQ(bus_.sent(), (debug::Dumps{"06 00 00 00 0c a0 01 00 00 00 00 00"}));
}

}  // namespace
}  // namespace vagus::session
