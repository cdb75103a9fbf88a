// Events, the run loop, and that machines are independent (sections 3.1, 3.6, 3.7).
#include "vm/vm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isa/isa.hpp"
#include "vm/test_machine.hpp"

namespace vagus::vm {

namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using wire::MessageType;

// Handlers: event 0 at 7 (an endless loop), event 9 at 8, local event 0 at 10; no init event.
const std::vector<uint16_t> kThreeHandlers = {0,  7,      0,      7,      9,      8,     0xfffe,
                                              10, 0x9000, 0x1009, 0x0000, 0x100a, 0x0000};

void load_three_handlers(TestMachine& machine) {
    machine.command(MessageType::SetBytecode, kThreeHandlers);
    machine.command(MessageType::Run);
    machine.sent();
}

}  // namespace

TEST(Vm, FreshIsIdleInRunningModeWithZeroVariables) {
    TestMachine machine;
    machine.command(MessageType::SetVariables, {0, 1, 2, 3});
    machine.bytecode[0] = 3;
    machine.bytecode[1] = 77;
    init(machine.vm, machine.config);
    EXPECT_THAT(machine.variables, Each(0));
    EXPECT_EQ(machine.bytecode[0], 0);
    EXPECT_EQ(machine.bytecode[1], 77);
    machine.command(MessageType::GetExecutionState);
    EXPECT_THAT(machine.sent(), ElementsAre(state(0, 0)));
    EXPECT_FALSE(start_event(machine.vm, isa::kInitEvent));
}

TEST(Vm, ChangingStateIsSmall) {
    EXPECT_LE(sizeof(Vm) - sizeof(const Config*), 24u);
}

TEST(Vm, SeveralAreIndependent) {
    TestMachine one;
    TestMachine two(Sizes{.variables = 200});
    one.load({0x1001, 0x4064, 0x9000});
    two.load({0x1002, 0x4065, 0x0000});
    one.run(10);
    two.run(10);
    EXPECT_EQ(one.variables[100], 1);
    EXPECT_EQ(one.variables[101], 0);
    EXPECT_EQ(two.variables[100], 0);
    EXPECT_EQ(two.variables[101], 2);
    EXPECT_TRUE(is_active(one.vm));
    EXPECT_FALSE(is_active(two.vm));
}

// ---- events ----

TEST(EventVector, FirstMatchWinsAndZeroMeansNone) {
    TestMachine machine;
    machine.command(MessageType::SetBytecode, {0, 9, 5, 20, 5, 21, 6, 0, 7, 22});
    EXPECT_EQ(event_address(machine.vm, 5), 20);
    EXPECT_EQ(event_address(machine.vm, 6), 0);
    EXPECT_EQ(event_address(machine.vm, 7), 22);
    EXPECT_EQ(event_address(machine.vm, 8), 0);
    EXPECT_FALSE(start_event(machine.vm, 6));
}

TEST(EventVector, IsReadOnlyInsideTheBytecode) {
    for (const uint16_t length : std::initializer_list<uint16_t>{9, 65534, 65535}) {
        TestMachine machine(Sizes{.bytecode = 4});
        machine.command(MessageType::SetBytecode, {0, length, 5, 2, 5});
        EXPECT_EQ(event_address(machine.vm, 5), 2);
        EXPECT_EQ(event_address(machine.vm, 6), 0);
    }
    TestMachine largest(Sizes{.bytecode = 65535});
    largest.bytecode[0] = 65535;
    largest.bytecode[65533] = 5;
    largest.bytecode[65534] = 8;
    EXPECT_EQ(event_address(largest.vm, 5), 8);
    EXPECT_EQ(event_address(largest.vm, 6), 0);
}

TEST(Event, StoresSourceAndArgumentsAlsoWithoutHandler) {
    TestMachine machine;
    machine.variables[0] = 11;
    machine.variables[5] = 33;
    machine.event(1234, {7, 0xfff8, 9}, 42);
    EXPECT_THAT(std::vector<int16_t>(machine.variables.begin(), machine.variables.begin() + 6),
                ElementsAre(11, 42, 7, -8, 9, 33));
    EXPECT_THAT(machine.sent(), IsEmpty());
}

TEST(Event, StoresAtMostTheCapacity) {
    TestMachine machine(Sizes{.arguments = 2});
    machine.event(0, {1, 2, 3});
    EXPECT_EQ(machine.variables[3], 2);
    EXPECT_EQ(machine.variables[4], 0);
}

TEST(Event, StoresNothingOutsideTheVariables) {
    for (const uint16_t size : std::initializer_list<uint16_t>{0, 1, 2, 3}) {
        TestMachine machine(Sizes{.variables = size});
        machine.event(0, std::vector<uint16_t>(258, 5), 6);
        for (size_t i = 0; i < size; ++i)
            EXPECT_EQ(machine.variables[i], i == 0 ? 0 : i == 1 ? 6 : 5);
    }
}

TEST(Event, NewestKillsTheRunningOne) {
    TestMachine machine;
    load_three_handlers(machine);
    machine.event(0);
    EXPECT_EQ(machine.run(100), 100);
    machine.event(9);
    EXPECT_THAT(machine.sent(), ElementsAre(frame(0x9008, {7})));
    EXPECT_EQ(machine.run(100), 2);
    EXPECT_THAT(machine.on_stack(), ElementsAre(9));
}

TEST(Event, WithoutHandlerLeavesTheRunningOne) {
    TestMachine machine;
    load_three_handlers(machine);
    machine.event(0);
    machine.event(5, {1});
    EXPECT_THAT(machine.sent(), IsEmpty());
    EXPECT_TRUE(is_active(machine.vm));
    EXPECT_EQ(machine.variables[2], 1);
}

TEST(Event, StartsWithAnEmptyStack) {
    TestMachine machine;
    load_three_handlers(machine);
    machine.event(9);
    machine.run(100);
    machine.event(9);
    machine.run(100);
    EXPECT_THAT(machine.on_stack(), ElementsAre(9));
}

TEST(Event, IsDroppedWholeWhilePausedInsideAnother) {
    TestMachine machine;
    load_three_handlers(machine);
    machine.event(0);
    machine.command(MessageType::Pause);
    machine.sent();
    machine.event(9, {1, 2}, 3);
    local_event(machine.vm, 0);
    EXPECT_THAT(machine.sent(), IsEmpty());
    EXPECT_EQ(machine.vm.pc, 7);
    EXPECT_EQ(machine.variables[1], 0);
    EXPECT_EQ(machine.variables[2], 0);
}

TEST(Event, IsSetUpAndReportedWhilePausedIdle) {
    TestMachine machine;
    load_three_handlers(machine);
    machine.command(MessageType::Pause);
    machine.sent();
    machine.event(9);
    EXPECT_THAT(machine.sent(), ElementsAre(state(8, 3)));
    EXPECT_EQ(machine.run(10), 0);
}

TEST(LocalEvent, StartsItsHandlerAndLeavesSourceAndArguments) {
    TestMachine machine;
    load_three_handlers(machine);
    machine.variables[1] = 5;
    local_event(machine.vm, 0);
    local_event(machine.vm, 1);  // no handler
    EXPECT_EQ(machine.run(100), 2);
    EXPECT_THAT(machine.on_stack(), ElementsAre(10));
    EXPECT_EQ(machine.variables[1], 5);
    machine.command(MessageType::Pause);
    machine.sent();
    local_event(machine.vm, 0);
    EXPECT_THAT(machine.sent(), ElementsAre(state(10, 3)));
}

// ---- the run loop ----

TEST(RunLoop, StopsAtItsLimitAndGoesOnNextTime) {
    TestMachine machine;
    machine.load({0x1001, 0x1002, 0x1003, 0x0000});
    EXPECT_EQ(machine.run(0), 0);
    EXPECT_EQ(machine.run(2), 2);
    EXPECT_EQ(machine.vm.flags, wire::kFlagActive);
    EXPECT_EQ(machine.run(2), 2);
    EXPECT_EQ(machine.vm.flags, 0);
    EXPECT_EQ(machine.run(2), 0);
    EXPECT_THAT(machine.sent(), IsEmpty());
}

TEST(RunLoop, EndsWithAFault) {
    TestMachine machine;
    machine.load({0x1001, 0xf000, 0x1002});
    EXPECT_EQ(machine.run(100), 2);
    EXPECT_EQ(machine.run(100), 0);
}

TEST(RunLoop, AfterAFaultRunOnlyLetsEventsInAgain) {
    TestMachine machine;
    load_three_handlers(machine);
    machine.bytecode[9] = 0xf000;
    machine.event(9);
    machine.run(100);
    machine.command(MessageType::Run);
    EXPECT_THAT(machine.sent(), ElementsAre(error(9, "bad instruction"), state(9, 0)));
    EXPECT_EQ(machine.run(100), 0);
    local_event(machine.vm, 0);
    EXPECT_EQ(machine.run(100), 2);
}

TEST(NodeError, FromTheGlueStopsTheScript) {
    TestMachine machine;
    machine.load({0x9000});
    machine.run(5);
    raise_node_error(machine.vm, "battery low");
    EXPECT_THAT(machine.sent(), ElementsAre(error(3, "battery low")));
    EXPECT_EQ(machine.vm.flags, wire::kFlagStep);
}

}  // namespace vagus::vm
