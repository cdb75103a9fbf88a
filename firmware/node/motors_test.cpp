// A board with motors stops when nothing is in command, whatever the script's variables say, and
// moves again only by what is written afterwards.
#include <gtest/gtest.h>

#include "firmware/board.hpp"
#include "firmware/node/fake_board.hpp"
#include "isa/isa.hpp"

namespace vagus::firmware {
namespace {

using isa::instruction;
using isa::Opcode;
using wire::MessageType;
using Words = std::vector<uint16_t>;
using Powers = std::array<int16_t, kMotors>;

constexpr uint16_t kHalts = 60;  // counted by the scripts
constexpr uint16_t kDriveEvent = 5, kFaultEvent = 6;
constexpr Powers kStill = {0, 0}, kDriving = {100, -50};

uint16_t binary(isa::BinaryOperator which) {
    return instruction(Opcode::Binary, static_cast<uint16_t>(which));
}

// onevent halted: variable 60 += 1; onevent 5: left = 100, right = -50; onevent 6: left = 1 / 0.
const Words kScript = {7, isa::kLocalEventFirst - kHaltedEvent, 17,  // behind the other two
                       kDriveEvent, 7, kFaultEvent, 12, instruction(Opcode::SmallImm, 100),
                       instruction(Opcode::Store, kMotorsAt),
                       instruction(Opcode::SmallImm, 0x1000 - 50),
                       instruction(Opcode::Store, kMotorsAt + 1), instruction(Opcode::Stop, 0),
                       // 12
                       instruction(Opcode::SmallImm, 1), instruction(Opcode::SmallImm, 0),
                       binary(isa::BinaryOperator::Divide), instruction(Opcode::Store, kMotorsAt),
                       instruction(Opcode::Stop, 0),
                       // 17
                       instruction(Opcode::Load, kHalts), instruction(Opcode::SmallImm, 1),
                       binary(isa::BinaryOperator::Add), instruction(Opcode::Store, kHalts),
                       instruction(Opcode::Stop, 0)};

class Motors : public testing::Test {
protected:
    void SetUp() override {
        board.first_id = 7;
        board.start();
        load(kScript);
        tell(MessageType::Run);
    }
    void tell(MessageType type, Words rest = {}) {
        rest.insert(rest.begin(), 7);
        board.hear(command(type, rest));
        if (type == MessageType::SetBytecode) board.wait_ms(kWitness_ms + 1);
    }
    void load(Words program) {
        program.insert(program.begin(), 0);
        tell(MessageType::SetBytecode, program);
    }
    void drive() {
        board.hear(event(3, kDriveEvent, {}));
        ASSERT_EQ(board.motors, kDriving);
    }
    static int16_t& variable(uint16_t at) { return board::kMachine.variables[at]; }
    int16_t halts() {
        board.settle();
        return variable(kHalts);
    }

    TestSlots slots;
    TestBoard board{slots};
};

TEST_F(Motors, FollowTheVariablesWhileTheProgramRuns) {
    EXPECT_EQ(board.motors, kStill);
    drive();
    tell(MessageType::SetVariables, {kMotorsAt, 7});
    EXPECT_EQ(board.motors, (Powers{7, -50}));
    EXPECT_EQ(halts(), 0);
}

TEST_F(Motors, StopWithEveryCommandThatEndsTheProgram) {
    for (const MessageType type : {MessageType::Stop, MessageType::Reset, MessageType::Pause}) {
        drive();
        const int16_t before = halts();
        tell(type);
        EXPECT_EQ(board.motors, kStill) << static_cast<int>(type);
        tell(MessageType::Run);
        EXPECT_EQ(board.motors, kStill) << "nothing was written since";
        EXPECT_EQ(halts(), before + 1);
        drive();
    }
}

TEST_F(Motors, StopWithANewProgramAndWithNone) {
    drive();
    load(kScript);
    EXPECT_EQ(board.motors, kStill);
    tell(MessageType::Run);
    EXPECT_EQ(halts(), 1);
    drive();
    load({0});
    tell(MessageType::Run);
    tell(MessageType::SetVariables, {kMotorsAt, 100, 100});
    EXPECT_EQ(board.motors, kStill) << "no program is in command";
}

TEST_F(Motors, StopWithAFault) {
    drive();
    board.hear(event(3, kFaultEvent, {}));
    EXPECT_EQ(board.motors, kStill);
    EXPECT_EQ(variable(kMotorsAt), 0);
}

TEST_F(Motors, StopAtABreakpointAndStayWhileStepping) {
    drive();
    tell(MessageType::BreakpointSet, {8});
    board.hear(event(3, kDriveEvent, {}));
    EXPECT_EQ(board.motors, kStill);
    for (int i = 0; i < 4; ++i) tell(MessageType::Step);  // to the end, over both writes
    EXPECT_EQ(board.motors, kStill);
    EXPECT_EQ(variable(kMotorsAt + 1), 0);
    tell(MessageType::BreakpointClearAll);
    tell(MessageType::Run);
    EXPECT_EQ(board.motors, kStill);
    EXPECT_EQ(halts(), 1);
}

TEST_F(Motors, AreNotToldToHaveHaltedIfTheyStood) {
    tell(MessageType::Stop);
    tell(MessageType::Run);
    EXPECT_EQ(halts(), 0);
}

TEST_F(Motors, WhatIsWrittenWhileNothingIsInCommandMovesNothingLater) {
    tell(MessageType::Stop);
    tell(MessageType::SetVariables, {kMotorsAt, 100, 100});
    EXPECT_EQ(board.motors, kStill);
    tell(MessageType::Run);
    EXPECT_EQ(board.motors, kStill);
    EXPECT_EQ(halts(), 1);
}

// A script that never ends its handler gets 1,000 instructions before the next event, but none
// before a command.
TEST_F(Motors, ABusyScriptDoesNotDelayStop) {
    // init: left = 100, then for ever nothing
    load({3, isa::kInitEvent, 3, instruction(Opcode::SmallImm, 100),
          instruction(Opcode::Store, kMotorsAt), instruction(Opcode::Jump, 0)});
    tell(MessageType::Run);
    while (board.motors == kStill) turn(board.firmware);
    for (const uint8_t byte : bytes_of(command(MessageType::Stop, {7}))) board::on_byte(byte);
    board.firmware.executed = 0;
    turn(board.firmware);
    EXPECT_EQ(board.motors, kStill);
}

}  // namespace
}  // namespace vagus::firmware
