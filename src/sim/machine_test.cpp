#include "sim/machine.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "node/natives.hpp"
#include "wire/messages.hpp"

using namespace vagus;
using namespace vagus::sim;

namespace {

constexpr node::Variable kVariables[] = {{1, "_id"}, {1, "event.source"}, {4, "event.args"}};
constexpr node::LocalEvent kEvents[] = {{"a", ""}, {"b", ""}, {"c", ""}};
constexpr node::Description kDescription = {
    "tested",
    wire::kProtocolVersion,
    node::LocalEventSource::OwnId,
    3,
    kVariables,
    3,
    kEvents,
    {{node::kStandardNatives, node::kStandardNativeCount}, {nullptr, 0}},
    0};
constexpr uint16_t kId = 5;

struct Tested {
    Machine machine{{.description = &kDescription,
                     .id = kId,
                     .bytecode_size = 64,
                     .stack_size = 8,
                     .variables_size = 64,
                     .arguments_size = 4}};

    template <typename Message>
    void send(const Message& message) {
        wire::Frame frame;
        ASSERT_EQ(wire::encode_message(message, wire::kHostId, frame), wire::Error::None);
        machine.receive(frame);
    }
    void load(const std::vector<uint16_t>& program) {
        machine.begin_millisecond();
        wire::SetBytecode load{};
        load.dest = kId;
        load.words.count = static_cast<uint16_t>(program.size());
        for (size_t i = 0; i < program.size(); ++i)
            load.words.values[i] = static_cast<int16_t>(program[i]);
        send(load);
        wire::Run run{};
        run.dest = kId;
        send(run);
        machine.forget_sent();
    }
    void user_event(uint16_t number) {
        wire::Frame frame{};
        frame.type = number;
        machine.receive(frame);
    }
    void millisecond() {
        machine.begin_millisecond();
        machine.run();
    }
    size_t kills() {
        size_t count = 0;
        for (const wire::Frame& frame : machine.sent())
            if (frame.type == static_cast<uint16_t>(wire::MessageType::EventExecutionKilled))
                ++count;
        return count;
    }
};

// Local event 0 (id 0xfffe) counts in variable 10 for ever; local event 1 (0xfffd) adds 1 to
// variable 11 and ends; user event 0 adds 1 to variable 12 and ends. docs/spec, 3.3 and 3.4.
const std::vector<uint16_t> kProgram = {
    7,      0x0000, 17,     0xfffd, 12,     0xfffe, 7,  // the vector
    0x300a, 0x1001, 0x8002, 0x400a, 0x9ffc,             // 7: v10 = v10 + 1, and back to 7
    0x300b, 0x1001, 0x8002, 0x400b, 0x0000,             // 12: v11 = v11 + 1
    0x300c, 0x1001, 0x8002, 0x400c, 0x0000};            // 17: v12 = v12 + 1

// Where it was each time, and what variable 12 was by then.
struct Steps final : Witness {
    explicit Steps(const Machine& watched) : machine(watched) {}

    void executes(const WitnessedNode& node, uint16_t pc) override {
        EXPECT_EQ(node.robot, 3u);
        EXPECT_EQ(node.id, kId);
        steps.emplace_back(pc, machine.variable(12));
    }

    const Machine& machine;
    std::vector<std::pair<int, int>> steps;
};

// User event 0, heard once: five instructions from word 17 on, of which the fourth writes.
TEST(Machine, AWitnessSeesEachInstructionBeforeItIsExecuted) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.begin_millisecond();
    Steps seen(tested.machine);
    tested.machine.watch(&seen, {3, kId});
    tested.user_event(0);
    using Expected = std::vector<std::pair<int, int>>;
    EXPECT_EQ(seen.steps, (Expected{{17, 0}, {18, 0}, {19, 0}, {20, 0}, {21, 1}}));
    tested.machine.watch(nullptr, {3, kId});
    tested.user_event(0);
    EXPECT_EQ(seen.steps.size(), 5u);
    EXPECT_EQ(tested.machine.variable(12), 2);
}

TEST(Machine, AMillisecondIsAThousandInstructions) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.raise(0);
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(10), 200);  // five instructions a round
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(10), 400);
    EXPECT_EQ(tested.kills(), 0u);
}

TEST(Machine, ALocalEventWaitsUntilTheRunningOneHasHadItsThousand) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.raise(0);
    tested.machine.raise(1);
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(10), 200);
    EXPECT_EQ(tested.machine.variable(11), 0);
    tested.millisecond();  // now the endless one is killed
    EXPECT_EQ(tested.machine.variable(10), 200);
    EXPECT_EQ(tested.machine.variable(11), 1);
    EXPECT_EQ(tested.kills(), 1u);
}

TEST(Machine, EventsOfOneInstantAllRunInTheirOrder) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.raise(1);
    tested.machine.raise(2);  // no handler
    tested.machine.raise(0);
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(11), 1);
    EXPECT_EQ(tested.machine.variable(10), 199);  // 5 instructions of 1000 went to event 1
    EXPECT_EQ(tested.kills(), 0u);
}

TEST(Machine, AnEventThatWaitsIsNotQueuedTwice) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.raise(1);
    tested.machine.raise(1);
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(11), 1);
}

TEST(Machine, AUserEventKillsAtOnce) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.raise(0);
    tested.millisecond();
    tested.machine.begin_millisecond();
    tested.user_event(0);
    EXPECT_EQ(tested.machine.variable(12), 1);
    EXPECT_EQ(tested.kills(), 1u);
}

TEST(Machine, LocalEventsCarryTheOwnIdAsSource) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.raise(2);
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(1), kId);
}

TEST(Machine, LooksAtNoMoreThanSixteenFramesAMillisecond) {
    Tested tested;
    tested.machine.begin_millisecond();
    for (int i = 0; i < kFramesPerMillisecond; ++i) {
        EXPECT_TRUE(tested.machine.wants_frame()) << i;
        tested.user_event(3);
    }
    EXPECT_FALSE(tested.machine.wants_frame());
    tested.machine.begin_millisecond();
    EXPECT_TRUE(tested.machine.wants_frame());
}

TEST(Machine, WhoHasUsedUpItsInstructionsLooksAtNoFrame) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.raise(0);
    tested.machine.run();
    tested.machine.begin_millisecond();
    EXPECT_TRUE(tested.machine.wants_frame());
    tested.machine.run();
    EXPECT_FALSE(tested.machine.wants_frame());
}

TEST(Machine, PausedInsideAnEventItDropsLocalEvents) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.raise(0);
    tested.millisecond();
    wire::Pause pause{};
    pause.dest = kId;
    tested.machine.begin_millisecond();
    tested.send(pause);
    tested.machine.raise(1);
    tested.machine.run();
    wire::Run run{};
    run.dest = kId;
    tested.send(run);
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(11), 0);
    EXPECT_EQ(tested.machine.variable(10), 400);
}

TEST(Machine, OneMoreThanTheMostPendingEventsIsDropped) {
    Tested tested;
    tested.load(kProgram);
    for (size_t i = 2; i < 2 + kPendingEventsMax; ++i)
        tested.machine.raise(static_cast<uint8_t>(i));
    tested.machine.raise(1);  // full: dropped
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(11), 0);
    tested.machine.raise(1);
    tested.millisecond();
    EXPECT_EQ(tested.machine.variable(11), 1);
}

TEST(Machine, KnowsWhichEventsItsProgramHearsAndWhetherItHasAnythingToDo) {
    Tested tested;
    EXPECT_FALSE(tested.machine.hears(0));
    tested.load(kProgram);
    EXPECT_TRUE(tested.machine.hears(0));
    EXPECT_TRUE(tested.machine.hears(1));
    EXPECT_FALSE(tested.machine.hears(2));
    EXPECT_FALSE(tested.machine.is_busy());
    tested.machine.raise(1);
    EXPECT_TRUE(tested.machine.is_busy());
    tested.millisecond();
    EXPECT_FALSE(tested.machine.is_busy());  // the handler has ended
    tested.machine.raise(0);
    tested.millisecond();
    EXPECT_TRUE(tested.machine.is_busy());  // this one never ends
    tested.load({1, 0});                    // another program, without handlers
    EXPECT_FALSE(tested.machine.hears(0));
}

TEST(Machine, AnEventThatPassesUnheardIsItsOwnAllTheSame) {
    Tested tested;
    tested.load(kProgram);
    tested.machine.variable(1) = 9;  // event.source
    tested.machine.pass_unheard(2);
    EXPECT_EQ(tested.machine.variable(1), kId);
    EXPECT_FALSE(tested.machine.is_busy());
}

}  // namespace
