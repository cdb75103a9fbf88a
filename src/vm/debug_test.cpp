// What hosts can ask of the machine (section 2.3). The dumps of section 2.10 are here word for
// word.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isa/isa.hpp"
#include "vm/test_machine.hpp"

namespace vagus::vm {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using wire::MessageType;

std::string breakpoint_result(uint16_t pc, uint16_t success) {
    return frame(0x900b, {pc, success});
}

// A program whose init event never ends: jump to itself at 3.
constexpr uint16_t kLoop = 0x9000;

}  // namespace

// ---- section 2.10 ----

TEST(Dump, UploadRunAndReceiveAnEvent) {
    TestMachine machine;
    machine.receive(
        "28 00 00 00 01 a0 01 00 00 00 05 00 ff ff 05 00 00 00 0d 00 02 10 03 10 02 80 64 40 "
        "04 b0 64 00 02 00 00 00 65 30 01 10 02 80 65 40 00 00");
    EXPECT_THAT(machine.sent(), ElementsAre("04 00 01 00 0a 90 05 00 03 00"));
    machine.receive("02 00 00 00 03 a0 01 00");
    EXPECT_THAT(machine.sent(), ElementsAre("04 00 01 00 0a 90 05 00 01 00"));
    machine.run(1000);
    EXPECT_THAT(machine.sent(), ElementsAre("04 00 01 00 04 00 05 00 00 00"));
    machine.event(0);
    EXPECT_EQ(machine.run(1000), 5);
    EXPECT_EQ(machine.variables[101], 1);
}

TEST(Dump, VariablesAndUserEvents) {
    TestMachine machine;
    machine.variables[100] = 5;
    machine.receive("06 00 00 00 0b a0 01 00 64 00 02 00");
    EXPECT_THAT(machine.sent(), ElementsAre("06 00 01 00 05 90 64 00 05 00 00 00"));
    machine.receive("08 00 00 00 0c a0 01 00 64 00 34 12 ff ff");
    EXPECT_EQ(machine.variables[100], 0x1234);
    EXPECT_EQ(machine.variables[101], -1);
    machine.receive("04 00 2a 00 00 00 07 00 f8 ff");
    machine.receive("06 00 00 00 0b a0 01 00 00 00 06 00");
    EXPECT_THAT(machine.sent(),
                ElementsAre("0e 00 01 00 05 90 00 00 00 00 2a 00 07 00 f8 ff 00 00 00 00"));
}

TEST(Dump, DivisionByZero) {
    TestMachine machine;
    machine.receive(
        "14 00 00 00 01 a0 01 00 00 00 03 00 ff ff 03 00 05 10 64 30 05 80 65 40 00 00");
    machine.receive("02 00 00 00 03 a0 01 00");
    machine.run(1000);
    EXPECT_THAT(machine.sent(),
                ElementsAre("04 00 01 00 0a 90 03 00 03 00", "04 00 01 00 0a 90 03 00 01 00",
                            "02 00 01 00 07 90 05 00"));
    machine.receive("02 00 00 00 07 a0 01 00");
    EXPECT_THAT(machine.sent(), ElementsAre("04 00 01 00 0a 90 06 00 02 00"));
}

TEST(Dump, ArrayAccessOutOfBounds) {
    TestMachine machine;
    machine.receive(
        "14 00 00 00 01 a0 01 00 00 00 03 00 ff ff 03 00 05 10 64 50 03 00 65 40 00 00");
    machine.receive("02 00 00 00 03 a0 01 00");
    machine.sent();
    machine.run(1000);
    EXPECT_THAT(machine.sent(), ElementsAre("06 00 01 00 06 90 04 00 03 00 05 00"));
    machine.receive("02 00 00 00 07 a0 01 00");
    EXPECT_THAT(machine.sent(), ElementsAre("04 00 01 00 0a 90 04 00 02 00"));
}

TEST(Dump, Breakpoint) {
    TestMachine machine;
    const auto answer = [&machine](const char* frame) {
        machine.receive(frame);
        machine.run(1000);
        return machine.sent();
    };
    machine.receive(
        "14 00 00 00 01 a0 01 00 00 00 03 00 ff ff 03 00 01 10 64 40 02 10 65 40 00 00");
    EXPECT_THAT(machine.sent(), ElementsAre("04 00 01 00 0a 90 03 00 03 00"));
    EXPECT_THAT(answer("04 00 00 00 08 a0 01 00 05 00"),
                ElementsAre("04 00 01 00 0b 90 05 00 01 00"));
    const char* const run_command = "02 00 00 00 03 a0 01 00";
    const char* const step_command = "02 00 00 00 05 a0 01 00";
    EXPECT_THAT(answer(run_command),
                ElementsAre("04 00 01 00 0a 90 03 00 01 00", "04 00 01 00 0a 90 05 00 07 00"));
    // Run again: no progress, and RUNNING is still there (D8).
    EXPECT_THAT(answer(run_command),
                ElementsAre("04 00 01 00 0a 90 05 00 05 00", "04 00 01 00 0a 90 05 00 07 00"));
    EXPECT_THAT(answer(step_command), ElementsAre("04 00 01 00 0a 90 06 00 07 00"));
    EXPECT_THAT(answer(step_command), ElementsAre("04 00 01 00 0a 90 07 00 07 00"));
    EXPECT_THAT(answer(run_command), ElementsAre("04 00 01 00 0a 90 07 00 05 00"));
    EXPECT_THAT(answer("06 00 00 00 0b a0 01 00 64 00 02 00"),
                ElementsAre("06 00 01 00 05 90 64 00 01 00 02 00"));
}

TEST(Dump, KilledEventAndNodeSpecificError) {
    TestMachine machine;
    // Init at 5 is an endless loop, event 0 at 6 calls a native that fails like math.sqrt.
    machine.command(MessageType::SetBytecode, {0, 5, 0, 6, 0xffff, 5, kLoop, 0xc013, 0});
    machine.native = [](Vm& vm, uint16_t) { raise_node_error(vm, "Negative input to sqrt"); };
    machine.command(MessageType::Run);
    EXPECT_EQ(machine.run(100), 100);
    machine.sent();
    machine.receive("00 00 03 00 00 00");
    EXPECT_THAT(machine.sent(), ElementsAre("02 00 01 00 08 90 05 00"));
    machine.run(100);
    EXPECT_THAT(machine.sent(),
                ElementsAre("19 00 01 00 09 90 06 00 16 4e 65 67 61 74 69 76 65 20 69 6e 70 75 74 "
                            "20 74 6f 20 73 71 72 74"));
}

// ---- who is meant ----

TEST(Commands, ForOthersOrUnknownOrShortAreIgnored) {
    TestMachine machine;
    machine.load({kLoop});
    const Vm before = machine.vm;
    for (uint32_t type = 0x8000; type <= 0xffff; ++type) {
        const uint16_t other_node[] = {2, 0, 1};
        receive(machine.vm, static_cast<uint16_t>(type), other_node, 3);
        receive(machine.vm, static_cast<uint16_t>(type), nullptr, 0);
        if (type >= 0xa001 && type <= 0xa00f) continue;
        const uint16_t this_node[] = {1, 0, 1};
        receive(machine.vm, static_cast<uint16_t>(type), this_node, 3);
    }
    const MessageType one_word_more[] = {MessageType::SetBytecode, MessageType::BreakpointSet,
                                         MessageType::BreakpointClear, MessageType::SetVariables,
                                         MessageType::GetVariables};
    for (const MessageType type : one_word_more) machine.command(type);
    machine.command(MessageType::GetVariables, {0});
    EXPECT_THAT(machine.sent(), IsEmpty());
    EXPECT_EQ(machine.vm.flags, before.flags);
    EXPECT_EQ(machine.vm.pc, before.pc);
    EXPECT_EQ(machine.vm.breakpoint_count, 0);
}

// ---- execution ----

TEST(Reset, StartsTheInitEventInStepModeAndKeepsTheRest) {
    TestMachine machine;
    machine.load({0x1001, kLoop});
    machine.run(10);
    machine.variables[100] = 8;
    machine.command(MessageType::BreakpointSet, {4});
    machine.sent();
    machine.notices.clear();
    machine.command(MessageType::Reset);  // an event is active: no EventExecutionKilled
    EXPECT_THAT(machine.sent(), ElementsAre(state(3, 3)));
    EXPECT_THAT(machine.notices, ElementsAre(Notice::Reset));
    EXPECT_EQ(machine.variables[100], 8);
    EXPECT_EQ(machine.vm.breakpoint_count, 1);
    EXPECT_EQ(machine.bytecode[3], 0x1001);
}

TEST(Reset, WithoutInitEventKeepsThePcAndIsIdle) {
    TestMachine machine;
    machine.command(MessageType::SetBytecode, {0, 3, 7, 3, 0x1001, 0});
    EXPECT_THAT(machine.sent(), ElementsAre(state(0, 2)));
    machine.command(MessageType::Run);
    machine.event(7);
    machine.run(10);
    machine.sent();
    machine.command(MessageType::Reset);
    EXPECT_THAT(machine.sent(), ElementsAre(state(4, 2)));
}

// D2. Appendix C: V = 3, words from 3 alternating A300 0002: the original leaves words 3 and 5.
TEST(Reset, ForgetsEveryWhen) {
    TestMachine machine;
    machine.command(MessageType::SetBytecode,
                    {0, 3, 7, 3, 0xa300, 2, 0xa300, 2, 0xa300, 2, 0xa300, 2, 0});
    for (const int at : {3, 5, 7, 9}) {
        EXPECT_EQ(machine.bytecode[static_cast<size_t>(at)], 0xa100) << at;
        machine.bytecode[static_cast<size_t>(at)] = 0xa300;
    }
    machine.command(MessageType::Reset);
    for (const int at : {3, 5, 7, 9}) {
        EXPECT_EQ(machine.bytecode[static_cast<size_t>(at)], 0xa100) << at;
    }
}

// Operands and the event vector may look like branches; clearing them would change the program.
TEST(Reset, LeavesWordsThatAreNoInstructions) {
    TestMachine machine;
    const std::vector<uint16_t> image = {3,      0xa300, 3,      0x2000, 0xa300, 0xb001,
                                         0xa300, 0xa300, 0x5001, 0xa300, 0};
    std::vector<uint16_t> words = {0};
    words.insert(words.end(), image.begin(), image.end());
    machine.command(MessageType::SetBytecode, words);
    EXPECT_TRUE(std::equal(image.begin(), image.end(), machine.bytecode.begin()));
}

TEST(Reset, SurvivesAnyEventVector) {
    for (const uint16_t size : std::initializer_list<uint16_t>{1, 2, 3, 65535}) {
        for (const uint16_t vector : std::initializer_list<uint16_t>{0, 1, 2, 3, 4, 65534, 65535}) {
            TestMachine machine(Sizes{.bytecode = size});
            std::fill(machine.bytecode.begin(), machine.bytecode.end(), uint16_t{0xa300});
            machine.bytecode[0] = vector;
            machine.command(MessageType::Reset);
            EXPECT_THAT(machine.sent(), ElementsAre(state(0, 2)));
        }
    }
}

TEST(Run, OnlyClearsStepAndSaysSo) {
    TestMachine machine;
    machine.command(MessageType::Stop);
    machine.sent();
    machine.command(MessageType::Run);
    EXPECT_THAT(machine.sent(), ElementsAre(state(0, 0)));
    EXPECT_THAT(machine.notices, ElementsAre(Notice::Run));
    EXPECT_EQ(machine.run(10), 0);
}

TEST(Pause, StopsInsideTheEventAndRunGoesOn) {
    TestMachine machine;
    machine.load({0x1001, 0x1002, 0});
    machine.run(1);
    machine.command(MessageType::Pause);
    EXPECT_THAT(machine.sent(), ElementsAre(state(4, 3)));
    EXPECT_EQ(machine.run(10), 0);
    machine.command(MessageType::Run);
    EXPECT_EQ(machine.run(10), 2);
    EXPECT_EQ(machine.vm.flags, 0);
}

TEST(Step, ExecutesOneInstructionEvenInRunningModeAndAtABreakpoint) {
    TestMachine machine;
    machine.load({0x1001, 0x1002, 0});
    machine.command(MessageType::BreakpointSet, {3});
    machine.sent();
    machine.command(MessageType::Step);
    EXPECT_THAT(machine.sent(), ElementsAre(state(4, 1)));
}

TEST(Step, WhenIdleDoesAndSaysNothing) {
    TestMachine machine;
    machine.load({0});
    machine.run(10);
    machine.command(MessageType::Step);
    EXPECT_THAT(machine.sent(), IsEmpty());
}

TEST(Step, AfterAFaultDoesNothing) {
    TestMachine machine;
    machine.execute({0xf000});
    machine.command(MessageType::Step);
    EXPECT_THAT(machine.sent(), IsEmpty());
}

TEST(Stop, AbandonsTheEventSilentlyAndKeepsThePc) {
    TestMachine machine;
    machine.load({0x1001, kLoop});
    machine.run(10);
    machine.command(MessageType::Stop);
    EXPECT_THAT(machine.sent(), ElementsAre(state(4, 2)));
}

TEST(Notices, TellTheSurroundings) {
    TestMachine machine;
    machine.command(MessageType::WriteBytecode);
    machine.command(MessageType::Reboot);
    machine.command(MessageType::SuspendToRam);
    EXPECT_THAT(machine.notices, ElementsAre(Notice::WriteBytecode, Notice::Reboot, Notice::Sleep));
    EXPECT_THAT(machine.sent(), IsEmpty());
}

// ---- breakpoints ----

TEST(Breakpoints, SixteenFitTheSeventeenthDoesNot) {
    TestMachine machine;
    for (uint16_t i = 0; i < kBreakpointsMax; ++i) {
        machine.command(MessageType::BreakpointSet, {static_cast<uint16_t>(10 + i)});
        EXPECT_THAT(machine.sent(),
                    ElementsAre(breakpoint_result(static_cast<uint16_t>(10 + i), 1)));
    }
    machine.command(MessageType::BreakpointSet, {99});
    EXPECT_THAT(machine.sent(), ElementsAre(breakpoint_result(99, 0)));
    machine.command(MessageType::BreakpointSet, {25});  // is there already (D17)
    EXPECT_THAT(machine.sent(), ElementsAre(breakpoint_result(25, 1)));
    machine.command(MessageType::BreakpointClear, {10});
    machine.command(MessageType::BreakpointSet, {99});
    EXPECT_THAT(machine.sent(), ElementsAre(breakpoint_result(99, 1)));
}

TEST(Breakpoints, AreASet) {
    TestMachine machine;
    machine.load({0x1001, 0x1002, 0});
    machine.command(MessageType::BreakpointSet, {4});
    machine.command(MessageType::BreakpointSet, {4});
    EXPECT_EQ(machine.vm.breakpoint_count, 1);
    machine.command(MessageType::BreakpointClear, {4});
    EXPECT_EQ(machine.run(10), 3);
}

TEST(Breakpoints, OutsideTheBytecodeAreRefused) {
    TestMachine machine;
    machine.command(MessageType::BreakpointSet, {299});
    machine.command(MessageType::BreakpointSet, {300});
    EXPECT_THAT(machine.sent(), ElementsAre(breakpoint_result(299, 1), breakpoint_result(300, 0)));
}

TEST(Breakpoints, ClearTakesTheOneNamedAndClearAllTheRest) {
    TestMachine machine;
    machine.load({0x1001, 0x1001, 0x1001, 0x1001, 0});
    for (const uint16_t pc : std::initializer_list<uint16_t>{4, 5, 6})
        machine.command(MessageType::BreakpointSet, {pc});
    machine.command(MessageType::BreakpointClear, {4});
    machine.command(MessageType::BreakpointClear, {77});
    machine.sent();
    EXPECT_EQ(machine.run(10), 2);
    EXPECT_THAT(machine.sent(), ElementsAre(state(5, 7)));
    machine.command(MessageType::BreakpointClearAll);
    machine.command(MessageType::Run);
    EXPECT_EQ(machine.run(10), 3);
    EXPECT_THAT(machine.sent(), ElementsAre(state(5, 5)));
}

// ---- memories ----

TEST(GetVariables, OutsideAreLeftOut) {
    TestMachine machine;
    machine.variables[599] = 4;
    machine.command(MessageType::GetVariables, {599, 5});
    machine.command(MessageType::GetVariables, {600, 1});
    machine.command(MessageType::GetVariables, {65535, 65535});
    machine.command(MessageType::GetVariables, {5, 0});
    EXPECT_THAT(machine.sent(), ElementsAre(frame(0x9005, {599, 4}), frame(0x9005, {600}),
                                            frame(0x9005, {65535}), frame(0x9005, {5})));
}

TEST(SetVariables, OutsideAreIgnored) {
    TestMachine machine;
    machine.command(MessageType::SetVariables, {598, 1, 2, 3, 4});
    machine.command(MessageType::SetVariables, {600, 5});
    machine.command(MessageType::SetVariables, {65535, 6, 7});
    EXPECT_EQ(machine.variables[598], 1);
    EXPECT_EQ(machine.variables[599], 2);
    EXPECT_EQ(machine.variables[0], 0);
    EXPECT_THAT(machine.sent(), IsEmpty());
}

TEST(SetBytecode, OutsideIsIgnored) {
    TestMachine machine;
    machine.command(MessageType::SetBytecode, {298, 1, 2, 3});
    machine.command(MessageType::SetBytecode, {65535, 4, 5});
    EXPECT_EQ(machine.bytecode[298], 1);
    EXPECT_EQ(machine.bytecode[299], 2);
    EXPECT_EQ(machine.bytecode[0], 0);
    EXPECT_THAT(machine.sent(), ElementsAre(state(0, 2), state(0, 2)));
}

}  // namespace vagus::vm
