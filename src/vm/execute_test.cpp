// Every instruction: what it does, and how it stops the script when it must not be done.
// Programs start at address 3 (TestMachine::load); words are written as in the specification, 3.4.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isa/isa.hpp"
#include "vm/test_machine.hpp"

namespace vagus::vm {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr uint16_t kStop = 0x0000;

// Pushes `value`: two words.
#define PUSH(value) 0x2000, static_cast<uint16_t>(value)

std::string division_by_zero(uint16_t pc) {
    return frame(0x9007, {pc});
}
std::string out_of_bounds(uint16_t pc, uint16_t size, uint16_t index) {
    return frame(0x9006, {pc, size, index});
}

// Stopped by the instruction at `pc`, which must have changed neither pc nor stack.
void expect_stopped_at(const TestMachine& machine, uint16_t pc) {
    EXPECT_EQ(machine.vm.flags, wire::kFlagStep);
    EXPECT_EQ(machine.vm.pc, pc);
}

}  // namespace

// ---- what instructions do ----

TEST(Execute, StopEndsTheEventIgnoresItsArgumentAndStaysWhereItIs) {
    TestMachine machine;
    EXPECT_THAT(machine.execute({0x1007, 0x0abc}), IsEmpty());
    EXPECT_EQ(machine.vm.flags, 0);
    EXPECT_EQ(machine.vm.pc, 4);
    EXPECT_THAT(machine.on_stack(), ElementsAre(7));
}

TEST(Execute, SmallImmediateIsSignedTwelveBits) {
    TestMachine machine;
    machine.execute({0x1800, 0x17ff, 0x1fff, kStop});
    EXPECT_THAT(machine.on_stack(), ElementsAre(-2048, 2047, -1));
}

TEST(Execute, LoadAndStoreReachTheLastVariable) {
    TestMachine machine;
    machine.variables[599] = -5;
    EXPECT_THAT(machine.execute({0x3257, 0x4256, kStop}), IsEmpty());  // 0x257 is 599
    EXPECT_EQ(machine.variables[598], -5);
}

TEST(Execute, IndirectReachesTheLastElement) {
    TestMachine machine;
    machine.variables[102] = 9;
    EXPECT_THAT(machine.execute({0x1002, 0x5064, 3, 0x1002, 0x6067, 3, kStop}), IsEmpty());
    EXPECT_EQ(machine.variables[105], 9);
}

TEST(Execute, BinaryIgnoresBitsAboveTheOperator) {
    TestMachine machine;
    machine.execute({0x1002, 0x1003, 0x8f02, kStop});
    EXPECT_THAT(machine.on_stack(), ElementsAre(5));
}

TEST(Execute, UnaryIgnoresBitsAboveTheOperator) {
    TestMachine machine;
    machine.execute({0x1002, 0x7f00, kStop});
    EXPECT_THAT(machine.on_stack(), ElementsAre(-2));
}

TEST(Execute, JumpIsRelativeToItself) {
    TestMachine machine;
    machine.execute({0x9003, 0x1001, kStop, 0x1002, 0x9ffe});  // +3, then -2
    EXPECT_EQ(machine.vm.pc, 5);
    EXPECT_THAT(machine.on_stack(), ElementsAre(2));
}

TEST(Execute, EmitSendsVariables) {
    TestMachine machine;
    machine.variables[100] = 5;
    machine.variables[101] = -1;
    EXPECT_THAT(machine.execute({0xbfff, 100, 2, 0xb000, 100, 0, kStop}),
                ElementsAre(frame(0x0fff, {5, 0xffff}), frame(0, {})));
}

TEST(Execute, EmitSendsAtMost258Words) {
    TestMachine machine;
    const auto sent = machine.execute({0xb001, 0, 258, 0xb001, 0, 259, kStop});
    EXPECT_THAT(sent,
                ElementsAre(frame(1, std::vector<uint16_t>(258)), error(6, "event too long")));
    expect_stopped_at(machine, 6);
}

TEST(Execute, SubroutinesReturnBehindTheCall) {
    TestMachine machine;
    machine.execute({0xd006, 0x1001, kStop, 0x1002, 0x4064, 0xe000});
    EXPECT_EQ(machine.vm.pc, 5);
    EXPECT_EQ(machine.variables[100], 2);
    EXPECT_THAT(machine.on_stack(), ElementsAre(1));
}

// Return addresses are 16-bit patterns on a stack of signed words.
TEST(Execute, SubroutineReturnsToAnAddressAbove32767) {
    TestMachine machine(Sizes{.bytecode = 40000});
    machine.bytecode[0x9c00] = 0x1005;  // push 5
    machine.bytecode[0x9c01] = kStop;
    EXPECT_THAT(machine.execute({PUSH(0x9c00), 0xe000}), IsEmpty());
    EXPECT_EQ(machine.vm.pc, 0x9c01);
    EXPECT_THAT(machine.on_stack(), ElementsAre(5));
}

// ---- branches and `when` (3.5) ----

namespace {

// Runs a load of variable 100, a push and `branch_word` at 5 once; gives whether it was taken.
bool taken(TestMachine& machine, uint16_t branch_word, int16_t left) {
    machine.variables[100] = left;
    machine.bytecode[5] = branch_word;
    start_event(machine.vm, isa::kInitEvent);
    machine.run(3);
    return machine.vm.pc == 7;
}

}  // namespace

TEST(Branch, GoesOnOrSkips) {
    TestMachine machine;
    machine.load({0x3064, 0x1000, 0xa00b, 20});
    EXPECT_TRUE(taken(machine, 0xa00b, 1));
    EXPECT_FALSE(taken(machine, 0xa00b, 0));
    EXPECT_EQ(machine.vm.pc, 25);
    EXPECT_THAT(machine.on_stack(), IsEmpty());
}

TEST(Branch, WhenFiresOnEdgesOnly) {
    TestMachine machine;
    machine.load({0x3064, 0x1000, 0xa10b, 20});
    std::vector<bool> fired;
    for (const int16_t value : std::initializer_list<int16_t>{0, 1, 1, 0, 1}) {
        fired.push_back(taken(machine, machine.bytecode[5], value));
    }
    EXPECT_THAT(fired, ElementsAre(false, true, false, false, true));
}

TEST(Branch, RemembersAlsoWithoutWhen) {
    TestMachine machine;
    machine.load({0x3064, 0x1000, 0xa00b, 20});
    EXPECT_TRUE(taken(machine, 0xa00b, 1));
    EXPECT_EQ(machine.bytecode[5], 0xa20b);
    EXPECT_TRUE(taken(machine, machine.bytecode[5], 1));  // and is taken again all the same
    EXPECT_FALSE(taken(machine, machine.bytecode[5], 0));
    EXPECT_EQ(machine.bytecode[5], 0xa00b);
}

TEST(Branch, TakesAnyOperatorAsCondition) {
    TestMachine machine;
    machine.load({0x3064, 0x1003, 0xa003, 20});  // variable - 3
    EXPECT_TRUE(taken(machine, 0xa003, 2));
    EXPECT_FALSE(taken(machine, 0xa003, 3));
}

TEST(Branch, DivisionByZeroStopsForgetsAndSkips) {
    TestMachine machine;
    EXPECT_THAT(machine.execute({0x1005, 0x1000, 0xa305, 7, kStop}),
                ElementsAre(division_by_zero(5)));
    expect_stopped_at(machine, 12);
    EXPECT_THAT(machine.on_stack(), IsEmpty());
    EXPECT_EQ(machine.bytecode[5], 0xa105);
}

// ---- faults (3.8) ----

TEST(Fault, DivisionByZeroLeavesZeroAndGoesPast) {
    for (const uint16_t divide : std::initializer_list<uint16_t>{0x8005, 0x8006}) {
        TestMachine machine;
        EXPECT_THAT(machine.execute({0x1005, 0x1000, divide, kStop}),
                    ElementsAre(division_by_zero(5)));
        expect_stopped_at(machine, 6);
        EXPECT_THAT(machine.on_stack(), ElementsAre(0));
    }
}

TEST(Fault, LoadOutOfBoundsChangesNothing) {
    TestMachine machine;
    EXPECT_THAT(machine.execute({0x1005, 0x5064, 3, kStop}), ElementsAre(out_of_bounds(4, 3, 5)));
    expect_stopped_at(machine, 4);
    EXPECT_THAT(machine.on_stack(), ElementsAre(5));
}

TEST(Fault, StoreOutOfBoundsChangesNothing) {
    TestMachine machine;
    EXPECT_THAT(machine.execute({0x1007, 0x1003, 0x6064, 3, kStop}),
                ElementsAre(out_of_bounds(5, 3, 3)));
    expect_stopped_at(machine, 5);
    EXPECT_THAT(machine.on_stack(), ElementsAre(7, 3));
}

TEST(Fault, NegativeIndexIsALargeOne) {
    TestMachine machine;
    EXPECT_THAT(machine.execute({0x1fff, 0x5064, 3, kStop}),
                ElementsAre(out_of_bounds(4, 3, 0xffff)));
}

// ---- violations: what no compiler makes ----

struct Violation {
    const char* name;
    std::vector<uint16_t> code;  // at address 3
    uint16_t pc;                 // where it is noticed
    const char* text;
};

void PrintTo(const Violation& violation, std::ostream* out) {
    *out << violation.name;
}

class Violations : public testing::TestWithParam<Violation> {};

// 20 words of bytecode, 10 variables, 4 words of stack; all variables are 3 before and after.
TEST_P(Violations, StopTheScriptAndChangeNothing) {
    TestMachine machine(Sizes{.bytecode = 20, .variables = 10, .stack = 4});
    std::fill(machine.variables.begin(), machine.variables.end(), int16_t{3});
    EXPECT_THAT(machine.execute(GetParam().code),
                ElementsAre(error(GetParam().pc, GetParam().text)));
    expect_stopped_at(machine, GetParam().pc);
    EXPECT_THAT(machine.variables, testing::Each(3));
}

std::string name_of(const testing::TestParamInfo<Violation>& info) {
    return info.param.name;
}

// clang-format off
INSTANTIATE_TEST_SUITE_P(Stack, Violations, testing::ValuesIn(std::vector<Violation>{
    {"SmallImmOnFull", {0x1001, 0x1001, 0x1001, 0x1001, 0x1001}, 7, "stack full"},
    {"LargeImmOnFull", {0x1001, 0x1001, 0x1001, 0x1001, PUSH(1)}, 7, "stack full"},
    {"LoadOnFull", {0x1001, 0x1001, 0x1001, 0x1001, 0x3001}, 7, "stack full"},
    {"CallOnFull", {0x1001, 0x1001, 0x1001, 0x1001, 0xd003}, 7, "stack full"},
    {"StoreOnEmpty", {0x4001}, 3, "stack empty"},
    {"LoadIndOnEmpty", {0x5001, 2}, 3, "stack empty"},
    {"StoreIndOnOne", {0x1001, 0x6001, 2}, 4, "stack empty"},
    {"UnaryOnEmpty", {0x7000}, 3, "stack empty"},
    {"BinaryOnOne", {0x1001, 0x8002}, 4, "stack empty"},
    {"BranchOnOne", {0x1001, 0xa002, 2}, 4, "stack empty"},
    {"ReturnOnEmpty", {0xe000}, 3, "stack empty"},
}), name_of);

INSTANTIATE_TEST_SUITE_P(Addresses, Violations, testing::ValuesIn(std::vector<Violation>{
    {"Load", {0x300a}, 3, "bad address"},
    {"LoadFarAway", {0x3fff}, 3, "bad address"},
    {"Store", {0x1001, 0x400a}, 4, "bad address"},
    {"LoadIndPastTheEnd", {0x1002, 0x5008, 3}, 4, "bad address"},
    {"StoreIndPastTheEnd", {0x1001, 0x1002, 0x6008, 3}, 5, "bad address"},
    // 4095 + 61450 would be 9 in 16 bits.
    {"LoadIndThatWraps", {PUSH(61450), 0x5fff, 65535}, 5, "bad address"},
    {"StoreIndThatWraps", {0x1001, PUSH(61450), 0x6fff, 65535}, 6, "bad address"},
    {"LoadIndOfTheLastIndex", {PUSH(65534), 0x5001, 65535}, 5, "bad address"},
    {"EmitPastTheEnd", {0xb000, 8, 3}, 3, "bad address"},
    {"EmitNothingFromOutside", {0xb000, 11, 0}, 3, "bad address"},
    {"EmitThatWraps", {0xb000, 65535, 4}, 3, "bad address"},
    {"EmitTooLong", {0xb000, 0, 65535}, 3, "event too long"},
}), name_of);

#define FOURTEEN_ZEROES 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0

INSTANTIATE_TEST_SUITE_P(Instructions, Violations, testing::ValuesIn(std::vector<Violation>{
    {"Undefined", {0xf000}, 3, "bad instruction"},
    {"UnknownUnary", {0x1001, 0x7003}, 4, "bad instruction"},
    {"UnknownUnary255", {0x1001, 0x70ff}, 4, "bad instruction"},
    {"UnknownBinary", {0x1001, 0x1001, 0x8012}, 5, "bad instruction"},
    {"UnknownBranch", {0x1001, 0x1001, 0xa0ff, 2}, 5, "bad instruction"},
    {"JumpBehindTheEnd", {0x9011}, 20, "pc outside bytecode"},
    {"JumpBeforeTheBeginning", {0x9ffc}, 65535, "pc outside bytecode"},
    {"CallOutside", {0xdfff}, 4095, "pc outside bytecode"},
    {"ReturnOutside", {PUSH(65535), 0xe000}, 65535, "pc outside bytecode"},
    {"BranchOutside", {0x1000, 0x1000, 0xa00b, 1000}, 1005, "pc outside bytecode"},
    {"RunsOffTheEnd", {0x9010, FOURTEEN_ZEROES, 0, 0x9001}, 20, "pc outside bytecode"},
    {"TwoWordsAtTheEnd", {0x9010, FOURTEEN_ZEROES, 0, 0x2000}, 19, "pc outside bytecode"},
    {"ThreeWordsAtTheEnd", {0x900f, FOURTEEN_ZEROES, 0xb000, 0}, 18, "pc outside bytecode"},
}), name_of);
// clang-format on

// The largest memories that 16 bits can address: sums at the upper end must not wrap.
TEST(Violation, IsSeenInTheLargestMemories) {
    TestMachine machine(Sizes{.bytecode = 65535, .variables = 65535, .stack = 65535});
    machine.load({0x1001, 0xb000, 65535, 1, kStop});
    machine.vm.depth = 65535;
    machine.run(1);
    EXPECT_THAT(machine.sent(), ElementsAre(error(3, "stack full")));

    start_event(machine.vm, isa::kInitEvent);
    machine.sent();
    machine.command(wire::MessageType::Run);
    machine.run(2);
    EXPECT_THAT(machine.sent(), ElementsAre(state(3, 1), error(4, "bad address")));

    machine.bytecode[65534] = 0x2000;  // needs one word more than there is
    start_event(machine.vm, isa::kInitEvent);
    machine.vm.pc = 65534;
    machine.vm.flags = wire::kFlagActive;
    machine.sent();
    machine.run(1);
    EXPECT_THAT(machine.sent(), ElementsAre(error(65534, "pc outside bytecode")));
}

// ---- natives (4.1) ----

TEST(Native, PopsItsArgumentsAndTheMachineGoesOn) {
    TestMachine machine;
    machine.native = [](Vm& vm, uint16_t id) {
        EXPECT_EQ(id, 0xabc);
        const uint16_t address = pop(vm);
        const uint16_t size = pop(vm);
        int16_t* const place = memory(vm, address, size);
        ASSERT_NE(place, nullptr);
        place[size - 1] = 77;
    };
    EXPECT_THAT(machine.execute({0x1002, PUSH(598), 0xcabc, kStop}), IsEmpty());
    EXPECT_EQ(machine.variables[599], 77);
    EXPECT_EQ(machine.vm.pc, 7);
    EXPECT_THAT(machine.on_stack(), IsEmpty());
}

TEST(Native, FaultIsReportedOnceAtTheCallAndLeavesNoArguments) {
    TestMachine machine;
    machine.native = [](Vm& vm, uint16_t) {
        const uint16_t first = pop(vm);
        const uint16_t second = pop(vm);
        EXPECT_EQ(memory(vm, first, 2), nullptr);   // 599 and 600: one too far
        EXPECT_EQ(memory(vm, second, 2), nullptr);  // would do, but there was a fault already
    };
    EXPECT_THAT(machine.execute({0x1064, PUSH(599), 0xc000, kStop}),
                ElementsAre(error(6, "bad address")));
    expect_stopped_at(machine, 7);
    EXPECT_THAT(machine.on_stack(), IsEmpty());
}

TEST(Native, PoppingFromTheEmptyStackIsOneFault) {
    TestMachine machine;
    machine.native = [](Vm& vm, uint16_t) {
        EXPECT_EQ(pop(vm), 5);
        EXPECT_EQ(pop(vm), 0);
        EXPECT_EQ(pop(vm), 0);
        EXPECT_EQ(memory(vm, 0, 1), nullptr);
    };
    EXPECT_THAT(machine.execute({0x1005, 0xc000, kStop}), ElementsAre(error(4, "stack empty")));
    expect_stopped_at(machine, 5);
}

TEST(Native, MemoryEndsWhereTheVariablesEnd) {
    TestMachine machine;
    machine.native = [](Vm& vm, uint16_t) {
        EXPECT_EQ(memory(vm, 0, 600), vm.config->variables);
        EXPECT_EQ(memory(vm, 600, 0), vm.config->variables + 600);
        EXPECT_EQ(memory(vm, 65535, 2), nullptr);
    };
    EXPECT_THAT(machine.execute({0xc000, kStop}), ElementsAre(error(3, "bad address")));
}

TEST(Native, CanRaiseEachFault) {
    struct {
        void (*native)(Vm& vm, uint16_t id);
        std::string sent;
    } const cases[] = {
        {[](Vm& vm, uint16_t) { raise_division_by_zero(vm); }, division_by_zero(3)},
        {[](Vm& vm, uint16_t) { raise_out_of_bounds(vm, 8, 9); }, out_of_bounds(3, 8, 9)},
        {[](Vm& vm, uint16_t) { raise_node_error(vm, "no"); }, error(3, "no")},
    };
    for (const auto& one : cases) {
        TestMachine machine;
        machine.native = one.native;
        EXPECT_THAT(machine.execute({0xc000, kStop}), ElementsAre(one.sent));
        expect_stopped_at(machine, 4);
    }
}

}  // namespace vagus::vm
