#include "fastvm/bytecode.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fastvm/run.hpp"
#include "isa/isa.hpp"
#include "vm/test_machine.hpp"

namespace vagus::fastvm {

namespace {

using testing::Each;
using testing::ElementsAre;

// A machine whose bytecode memory is ours. It starts at word 3, as TestMachine::load has it.
class Machine {
public:
    Machine() {
        test_.config.bytecode = bytecode.memory();
        vm::init(test_.vm, test_.config);
    }
    // A command, and the notices that it brought.
    void command(wire::MessageType type, const std::vector<uint16_t>& words) {
        test_.command(type, words);
        for (const vm::Notice notice : test_.notices) bytecode.notice(notice);
        test_.notices.clear();
    }
    uint16_t run() {
        command(wire::MessageType::Run, {});
        vm::start_event(test_.vm, isa::kInitEvent);
        return fastvm::run(test_.vm, bytecode, 1000);
    }
    std::vector<int16_t> on_stack() const { return test_.on_stack(); }

    Bytecode bytecode{300};

private:
    vm::TestMachine test_;
};

constexpr uint16_t kVariables = 10;

}  // namespace

TEST(Bytecode, BeginsWithZerosAndLoadPutsThemBehindTheProgram) {
    Bytecode bytecode(4);
    EXPECT_EQ(bytecode.size(), 4);
    EXPECT_THAT(bytecode.words(), Each(0));
    bytecode.load(std::vector<uint16_t>{1, 2, 3, 4});
    EXPECT_THAT(bytecode.words(), ElementsAre(1, 2, 3, 4));
    bytecode.load(std::vector<uint16_t>{5});
    EXPECT_THAT(bytecode.words(), ElementsAre(5, 0, 0, 0));
}

TEST(Bytecode, IsDecodedOnlyAsFarAsTheProgramGoes) {
    Bytecode bytecode(1500);
    EXPECT_EQ(bytecode.decoded_bytes(), 0u);
    bytecode.load(std::vector<uint16_t>{3, 0xffff, 3, 0x1001, 0x4005});
    // Five words, two zeros that may belong to the last instruction, and the cell at the end.
    EXPECT_EQ(bytecode.cells(kVariables, {}).size(), 8u);
    EXPECT_EQ(bytecode.decoded_bytes(), 8 * sizeof(Cell));
}

TEST(Bytecode, IsDecodedToItsLastWordAndNotBeyond) {
    Bytecode bytecode(2);
    bytecode.load(std::vector<uint16_t>{0x1001, 0x2000});  // the second word of 0x2000 is missing
    EXPECT_EQ(bytecode.cells(kVariables, {}).size(), 3u);
    EXPECT_EQ(bytecode.cells(kVariables, {})[1].cost, 0);
}

TEST(Bytecode, WhatAHostWritesIsRun) {
    Machine machine;
    machine.command(wire::MessageType::SetBytecode, {0, 3, 0xffff, 3, 0x1007, 0x0000});
    EXPECT_EQ(machine.run(), 2);
    EXPECT_THAT(machine.on_stack(), ElementsAre(7));
    machine.command(wire::MessageType::SetBytecode, {3, 0x1008});  // one word only
    EXPECT_EQ(machine.run(), 2);
    EXPECT_THAT(machine.on_stack(), ElementsAre(8));
}

TEST(Bytecode, WhatIsLoadedIsRun) {
    Machine machine;
    machine.bytecode.load(std::vector<uint16_t>{3, 0xffff, 3, 0x1007});
    machine.run();
    machine.bytecode.load(std::vector<uint16_t>{3, 0xffff, 3, 0x1009});
    EXPECT_EQ(machine.run(), 2);
    EXPECT_THAT(machine.on_stack(), ElementsAre(9));
}

// `when 1 == 1 do push 5 end`: not a second time, but again after a Reset, which clears the memory
// in the bytecode.
TEST(Bytecode, ResetMakesAWhenForget) {
    Machine machine;
    machine.bytecode.load(
        std::vector<uint16_t>{3, 0xffff, 3, 0x1001, 0x1001, 0xa10a, 3, 0x1005, 0});
    EXPECT_EQ(machine.run(), 5);
    EXPECT_EQ(machine.bytecode.words()[5], 0xa30a);
    EXPECT_EQ(machine.run(), 4);
    machine.command(wire::MessageType::Reset, {});
    EXPECT_EQ(machine.bytecode.words()[5], 0xa10a);
    EXPECT_EQ(machine.run(), 5);
}

}  // namespace vagus::fastvm
