// What is particular to the loop for hosts: instructions that are executed together, limits and
// stacks that are checked for a stretch at once. The instructions themselves are tested by the
// tests of vm, which this program runs as well.
#include "fastvm/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fastvm/decode.hpp"
#include "isa/isa.hpp"
#include "vm/test_machine.hpp"

namespace vagus::fastvm {

namespace {

using isa::Opcode;
using testing::ElementsAre;
using testing::IsEmpty;
using vm::TestMachine;

constexpr uint16_t kStop = 0x0000;

uint16_t op(Opcode opcode, int argument) {
    return isa::instruction(opcode, static_cast<uint16_t>(argument));
}
uint16_t binary(isa::BinaryOperator which) {
    return op(Opcode::Binary, static_cast<int>(which));
}

}  // namespace

// variable 12 = variable 10 + variable 11: four instructions, one cell.
TEST(FastRun, StopsInTheMiddleOfWhatIsExecutedTogether) {
    for (uint16_t limit = 0; limit <= 5; ++limit) {
        TestMachine machine;
        machine.load({op(Opcode::Load, 10), op(Opcode::Load, 11), binary(isa::BinaryOperator::Add),
                      op(Opcode::Store, 12), kStop});
        machine.variables[10] = 30;
        machine.variables[11] = 12;
        EXPECT_EQ(machine.run(limit), limit);
        const int depths[] = {0, 1, 2, 1, 0, 0};
        EXPECT_EQ(machine.vm.depth, depths[limit]);
        EXPECT_EQ(machine.vm.pc, limit == 5 ? 7 : 3 + limit);
        EXPECT_EQ(machine.variables[12], limit >= 4 ? 42 : 0);
        EXPECT_EQ(vm::is_active(machine.vm), limit < 5);
        EXPECT_EQ(machine.vm.flags & wire::kFlagRunning, 0);
    }
}

// The same with a breakpoint at each of its instructions in turn.
TEST(FastRun, StopsAtABreakpointInTheMiddleOfWhatIsExecutedTogether) {
    for (uint16_t at = 3; at <= 7; ++at) {
        TestMachine machine;
        machine.load({op(Opcode::Load, 10), op(Opcode::Load, 11), binary(isa::BinaryOperator::Add),
                      op(Opcode::Store, 12), kStop});
        machine.variables[10] = 30;
        machine.command(wire::MessageType::BreakpointSet, {at});
        machine.sent();
        EXPECT_EQ(machine.run(100), at - 3);
        EXPECT_EQ(machine.vm.pc, at);
        // Section 3.7: STEP is set, ACTIVE and RUNNING stay.
        EXPECT_EQ(machine.vm.flags, 7);
        EXPECT_THAT(machine.sent(), ElementsAre(vm::state(at, 7)));
        EXPECT_EQ(machine.variables[12], at == 7 ? 30 : 0);
    }
}

// Only the instruction with the breakpoint, and stretches end before it.
TEST(FastRun, ABreakpointLeavesAllElseToTheFastLoop) {
    const std::vector<uint16_t> words = {op(Opcode::Load, 10), op(Opcode::Load, 11),
                                         binary(isa::BinaryOperator::Add), op(Opcode::Store, 12),
                                         kStop};
    const std::vector<uint16_t> breakpoints = {2, 1000};
    const Cells cells = decode(words, 600, breakpoints);
    std::vector<int> costs;
    for (size_t i = 0; i < words.size(); ++i) costs.push_back(cells[i].cost);
    EXPECT_THAT(costs, ElementsAre(2, 1, 0, 2, 1));
}

TEST(FastRun, DivisionByZeroLeavesWhatTheSingleInstructionWouldLeave) {
    TestMachine machine;
    const auto sent =
        machine.execute({op(Opcode::Load, 10), op(Opcode::Load, 11),
                         binary(isa::BinaryOperator::Divide), op(Opcode::Store, 12), kStop});
    EXPECT_THAT(sent, ElementsAre(vm::frame(0x9007, {5})));
    EXPECT_EQ(machine.vm.pc, 6);
    EXPECT_EQ(machine.vm.flags, wire::kFlagStep);
    EXPECT_THAT(machine.on_stack(), ElementsAre(0));  // section 3.8
}

TEST(FastRun, AnIndexOutsideItsArrayLeavesTheStackAsItIs) {
    for (const Opcode opcode : {Opcode::LoadInd, Opcode::StoreInd}) {
        TestMachine machine;
        machine.load({0x1008, op(Opcode::Load, 10), op(opcode, 20), 4, kStop});
        machine.variables[10] = 4;
        machine.run(100);
        EXPECT_THAT(machine.sent(), ElementsAre(vm::frame(0x9006, {5, 4, 4})));
        EXPECT_EQ(machine.vm.pc, 5);
        EXPECT_THAT(machine.on_stack(), ElementsAre(8, 4));
    }
}

// One more instruction than a stretch may have, and many times as many.
TEST(FastRun, LongStretchesAreExecutedToTheirEnd) {
    for (const int stores : {kCostMax / 2, kCostMax / 2 + 1, 10 * kCostMax}) {
        TestMachine machine({.bytecode = 6000});
        std::vector<uint16_t> code;
        for (int i = 0; i < stores; ++i) {
            code.push_back(op(Opcode::SmallImm, i % 2000));
            code.push_back(op(Opcode::Store, i % 600));
        }
        code.push_back(kStop);
        machine.load(code);
        EXPECT_EQ(machine.run(20'000), 2 * stores + 1);
        EXPECT_EQ(machine.variables[static_cast<size_t>((stores - 1) % 600)], (stores - 1) % 2000);
        EXPECT_FALSE(vm::is_active(machine.vm));
    }
}

TEST(FastRun, AStretchThatGrowsTheStackByMoreThanACellCanSayIsExecuted) {
    for (const int words : {kStackMax, kStackMax + 1, 32}) {
        TestMachine machine;  // with a stack of 32 words
        std::vector<uint16_t> code(static_cast<size_t>(words), 0x1001);
        for (int i = 1; i < words; ++i) code.push_back(binary(isa::BinaryOperator::Add));
        code.push_back(op(Opcode::Store, 10));
        code.push_back(kStop);
        EXPECT_THAT(machine.execute(code), IsEmpty());
        EXPECT_EQ(machine.variables[10], words);
        EXPECT_EQ(machine.vm.depth, 0);
    }
}

// Pushes without end: the first that has no room is that behind the last word of the stack.
TEST(FastRun, TheStackIsFullAtTheSameInstruction) {
    for (const int words : {3, kStackMax - 1, kStackMax, kStackMax + 1, 40}) {
        const auto size = static_cast<uint16_t>(words);
        TestMachine machine({.stack = size});
        const auto sent = machine.execute(std::vector<uint16_t>(60, 0x1001));
        const auto at = static_cast<uint16_t>(3 + size);
        EXPECT_THAT(sent, ElementsAre(vm::error(at, "stack full")));
        EXPECT_EQ(machine.vm.depth, size);
    }
}

// Stores without end, with fewer words on the stack.
TEST(FastRun, TheStackIsEmptyAtTheSameInstruction) {
    for (const int stores : {2, kStackMax, kStackMax + 1, 60}) {
        TestMachine machine;
        std::vector<uint16_t> code = {0x1007, op(Opcode::Jump, 1)};  // a stretch of their own
        code.insert(code.end(), static_cast<size_t>(stores), op(Opcode::Store, 10));
        EXPECT_THAT(machine.execute(code), ElementsAre(vm::error(6, "stack empty")));
        EXPECT_EQ(machine.variables[10], 7);
        EXPECT_EQ(machine.vm.depth, 0);
    }
}

// A loop of one instruction, for as long as a run can be.
TEST(FastRun, AnEndlessLoopHasExactlyItsLimit) {
    TestMachine machine;
    machine.load({op(Opcode::Jump, 0)});
    EXPECT_EQ(machine.run(65'535), 65'535);
    EXPECT_EQ(machine.run(1), 1);
    EXPECT_EQ(machine.vm.pc, 3);
}

// Two subroutines that call each other for ever: the stack ends it.
TEST(FastRun, CallsWithoutEndFillTheStack) {
    TestMachine machine({.stack = 5});
    const auto sent = machine.execute({op(Opcode::SubCall, 4), op(Opcode::SubCall, 3)});
    // Return addresses 4, 5, 4, 5, 4 are on the stack; the sixth call is that at word 4.
    EXPECT_THAT(sent, ElementsAre(vm::error(4, "stack full")));
    EXPECT_THAT(machine.on_stack(), ElementsAre(4, 5, 4, 5, 4));
}

TEST(FastRun, AReturnToNowhereGoesThereAndIsStopped) {
    for (const uint16_t nowhere :
         {uint16_t{300}, uint16_t{0xfff0}}) {  // the bytecode has 300 words
        TestMachine machine;
        const auto sent = machine.execute({0x2000, nowhere, op(Opcode::SubRet, 0)});
        EXPECT_THAT(sent, ElementsAre(vm::error(nowhere, "pc outside bytecode")));
        EXPECT_EQ(machine.vm.depth, 0);
    }
}

// The last decoded words, the one cell behind them, and what lies behind that: a return leads to
// each, and finds the 0 there, which is Stop. The first that has no cell is the tenth word: three
// of the table, three of code, and three that may be the end of an instruction or leave.
TEST(FastRun, AReturnBehindTheProgramStopsAtThatWord) {
    for (uint16_t target = 6; target < 20; ++target) {
        TestMachine machine;
        machine.load({0x2000, target, op(Opcode::SubRet, 0)});
        ASSERT_EQ(decode({machine.bytecode.data(), machine.bytecode.size()}, 600, {}).size(), 9u);
        EXPECT_EQ(machine.run(100), 3) << target;
        EXPECT_EQ(machine.vm.pc, target);
        EXPECT_EQ(machine.vm.depth, 0);
        EXPECT_FALSE(vm::is_active(machine.vm));
    }
}

TEST(FastRun, ProgramsRunIntoTheZerosBehindThem) {
    TestMachine machine;
    EXPECT_THAT(machine.execute({op(Opcode::Jump, 200)}), IsEmpty());  // 0 is Stop
    EXPECT_EQ(machine.vm.pc, 203);
    EXPECT_FALSE(vm::is_active(machine.vm));
}

// Word 7 is the value of the LargeImm at 6, and a Branch for who jumps there. Its memory changes
// the value: 0xa00a, then 0xa20a.
TEST(FastRun, ABranchInsideAnotherInstructionChangesIt) {
    TestMachine machine;
    machine.execute(
        {0x1001, 0x1001, op(Opcode::Jump, 2), 0x2000, 0xa00a, 0x0002, op(Opcode::Jump, -3)});
    EXPECT_EQ(machine.bytecode[7], 0xa20a);
    EXPECT_THAT(machine.on_stack(), ElementsAre(static_cast<int16_t>(0xa20a)));
    EXPECT_EQ(machine.vm.pc, 8);
}

// The native finds its arguments and the address of its call, and the rest of the line runs behind
// it.
TEST(FastRun, NativesSeeTheMachineAsItIs) {
    TestMachine machine;
    std::vector<uint16_t> seen;
    machine.native = [&seen](vm::Vm& vm, uint16_t id) {
        seen = {id, vm.pc, vm.depth, vm.flags, vm::pop(vm)};
    };
    machine.execute({0x1005, 0x1006, op(Opcode::Native, 77), op(Opcode::Store, 10), kStop});
    EXPECT_THAT(seen, ElementsAre(77, 5, 2, wire::kFlagActive | wire::kFlagRunning, 6));
    EXPECT_EQ(machine.variables[10], 5);
    EXPECT_EQ(machine.vm.depth, 0);
}

TEST(FastRun, AFaultInANativeEndsTheRunBehindIt) {
    TestMachine machine;
    machine.native = [](vm::Vm& vm, uint16_t) { vm::raise_division_by_zero(vm); };
    machine.load({op(Opcode::Native, 0), 0x1001, kStop});
    EXPECT_EQ(machine.run(100), 1);
    EXPECT_THAT(machine.sent(), ElementsAre(vm::frame(0x9007, {3})));
    EXPECT_EQ(machine.vm.pc, 4);
    EXPECT_EQ(machine.vm.flags, wire::kFlagStep);
}

TEST(FastRun, EventsLeaveWithTheirArgumentsAndTheRunGoesOn) {
    TestMachine machine;
    machine.load({0x1007, op(Opcode::Store, 20), op(Opcode::Emit, 9), 20, 2, 0x1008, kStop});
    EXPECT_EQ(machine.run(100), 5);
    EXPECT_THAT(machine.sent(), ElementsAre(vm::frame(9, {7, 0})));
    EXPECT_THAT(machine.on_stack(), ElementsAre(8));
}

TEST(FastRun, ABreakpointStopsBeforeItsInstruction) {
    TestMachine machine;
    machine.load({0x1001, 0x1002, 0x1003, kStop});
    machine.command(wire::MessageType::BreakpointSet, {5});
    EXPECT_EQ(machine.run(100), 2);
    EXPECT_THAT(machine.on_stack(), ElementsAre(1, 2));
    EXPECT_TRUE(vm::is_paused_in_event(machine.vm));
    machine.command(wire::MessageType::BreakpointClearAll);
    machine.command(wire::MessageType::Run);
    EXPECT_EQ(machine.run(100), 2);
}

// The same value in every form that has a cell of its own: operands from variables, small and large
// numbers and the stack, results to the stack, to a variable, to a branch. 7 - 3 is 4.
TEST(FastRun, EveryFormOfACalculationHasTheSameResult) {
    const std::vector<std::vector<uint16_t>> lefts = {
        {op(Opcode::Load, 10)}, {0x1007}, {0x2000, 7}};
    const std::vector<std::vector<uint16_t>> rights = {
        {op(Opcode::Load, 11)}, {0x1003}, {0x2000, 3}, {op(Opcode::Load, 12), 0x7000}};
    for (const auto& left : lefts) {
        for (const auto& right : rights) {
            TestMachine machine;
            std::vector<uint16_t> operands = left;
            operands.insert(operands.end(), right.begin(), right.end());
            std::vector<uint16_t> code;
            const auto add = [&code](const std::vector<uint16_t>& words) {
                code.insert(code.end(), words.begin(), words.end());
            };
            add(operands);
            add({binary(isa::BinaryOperator::Subtract), op(Opcode::Store, 20)});
            add(operands);
            add({binary(isa::BinaryOperator::Subtract)});
            add(operands);
            add({0xa00c, 3, 0x1001, 0x1002, kStop});  // `if left > right`: goes on to 0x1001
            machine.load(code);
            machine.variables[10] = 7;
            machine.variables[11] = 3;
            machine.variables[12] = -3;
            machine.run(1000);
            EXPECT_EQ(machine.variables[20], 4);
            EXPECT_THAT(machine.on_stack(), ElementsAre(4, 1, 2));
        }
    }
}

}  // namespace vagus::fastvm
