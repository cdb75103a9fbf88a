// The whole node on a board of paper: what hosts and other nodes see of it.
#include "firmware/node/firmware.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/board.hpp"
#include "firmware/node/face.hpp"
#include "isa/isa.hpp"

#include "firmware/node/fake_board.hpp"

namespace vagus::firmware {
namespace {

using isa::instruction;
using isa::Opcode;
using wire::MessageType;
using Words = std::vector<uint16_t>;

constexpr uint16_t kUser = 44;  // a variable behind those that are described

uint16_t type_of(MessageType type) {
    return static_cast<uint16_t>(type);
}

int count(const std::vector<wire::Frame>& frames, uint16_t type) {
    return static_cast<int>(
        std::count_if(frames.begin(), frames.end(),
                      [&](const wire::Frame& frame) { return frame.type == type; }));
}

class NodeOfABoard : public testing::Test {
protected:
    void SetUp() override { restart(); }
    void restart() {
        board.reset();
        board = std::make_unique<TestBoard>(slots);
        board->first_id = 7;
        board->start();
        board->settle();
    }
    std::vector<wire::Frame> ask(MessageType type, Words words) {
        board->sent.clear();
        board->hear(command(type, words));
        if (type == MessageType::SetBytecode) board->wait_ms(kWitness_ms + 1);
        return board->said();
    }
    void load(const Words& program) {
        Words words{7, 0};
        words.insert(words.end(), program.begin(), program.end());
        (void)ask(MessageType::SetBytecode, words);
    }
    void run(const Words& program) {
        load(program);
        (void)ask(MessageType::Run, {7});
    }
    int16_t variable(uint16_t at) { return board::kMachine.variables[at]; }

    TestSlots slots;
    std::unique_ptr<TestBoard> board;
};

// onevent 5 (of the bus): variable 44 becomes 11.
const Words kOnFive = {3,
                       5,
                       3,
                       instruction(Opcode::SmallImm, 11),
                       instruction(Opcode::Store, kUser),
                       instruction(Opcode::Stop, 0)};
// init: emits event 9 without end.
const Words kEmitsForever = {
    3, isa::kInitEvent, 3, instruction(Opcode::Emit, 9), kUser, 2, instruction(Opcode::Jump, 0xffd),
    0};

TEST_F(NodeOfABoard, AnswersWithTheNumberItsMakerGaveIt) {
    const auto frames = ask(MessageType::ListNodes, {5});
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].source, 7);
    EXPECT_EQ(frames[0].type, type_of(MessageType::NodePresent));
    EXPECT_EQ(variable(0), 7);
}

TEST_F(NodeOfABoard, HasNumberOneWithoutAMaker) {
    board.reset();
    board = std::make_unique<TestBoard>(slots);
    board->start();
    board->hear(command(MessageType::ListNodes, {5}));
    EXPECT_EQ(board->said().at(0).source, 1);
}

// 1 header, 11 variables, 3 local events, 30 natives.
TEST_F(NodeOfABoard, DescribesItselfInPiecesThatFit) {
    for (const MessageType type : {MessageType::GetNodeDescription, MessageType::GetDescription}) {
        const auto frames =
            ask(type, {static_cast<uint16_t>(type == MessageType::GetDescription ? 4 : 7), 5});
        EXPECT_EQ(frames.size(), 45u);
        EXPECT_EQ(count(frames, 0x9001), 11);
        EXPECT_EQ(count(frames, 0x9002), 3);
        EXPECT_EQ(count(frames, 0x9003), 30);
        for (const wire::Frame& frame : frames)
            EXPECT_LE(wire::kHeaderSize + frame.size, kAnswerMax);
    }
    EXPECT_EQ(variable(kDroppedAt), 0);
}

TEST_F(NodeOfABoard, SendsAllVariablesInPieces) {
    for (uint16_t i = kUser; i < kTestVariables; ++i)
        board::kMachine.variables[i] = static_cast<int16_t>(i);
    const auto frames = ask(MessageType::GetVariables, {7, 30, 1000});
    Words values;
    for (const wire::Frame& frame : frames) {
        ASSERT_EQ(frame.type, type_of(MessageType::Variables));
        EXPECT_EQ(frame.first_word(), 30 + values.size());
        for (uint16_t i = 2; i < frame.size; i = static_cast<uint16_t>(i + 2)) {
            values.push_back(static_cast<uint16_t>(frame.payload[i] | (frame.payload[i + 1] << 8)));
        }
    }
    ASSERT_EQ(values.size(), kTestVariables - 30u);
    EXPECT_EQ(values[kUser - 30], kUser);
    EXPECT_EQ(values.back(), kTestVariables - 1);
}

TEST_F(NodeOfABoard, AnswersWhenVariablesBeyondTheLastAreAskedFor) {
    const auto frames = ask(MessageType::GetVariables, {7, kTestVariables, 1});
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].size, 2);
}

TEST_F(NodeOfABoard, RunsWhatIsLoaded) {
    run(kOnFive);
    board->hear(event(3, 5, {}));
    EXPECT_EQ(variable(kUser), 11);
    EXPECT_EQ(variable(1), 3);
}

TEST_F(NodeOfABoard, StartsTheSavedProgramByItself) {
    load(kOnFive);
    const auto said = ask(MessageType::WriteBytecode, {7});
    ASSERT_EQ(count(said, type_of(MessageType::NodeSpecificError)), 1);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(said[0].payload) + 3, 11), "Flashing OK");
    restart();
    board->hear(event(3, 5, {}));
    EXPECT_EQ(variable(kUser), 11);
}

// zlib's crc32 over the six words.
TEST_F(NodeOfABoard, TellsWhichProgramItHasAlsoAfterARestart) {
    const auto told = [&] {
        const auto frames = ask(MessageType::GetVariables, {7, kProgramAt, 2});
        return std::vector<uint8_t>(frames.at(0).payload + 2, frames.at(0).payload + 6);
    };
    EXPECT_THAT(told(), testing::ElementsAre(0, 0, 0, 0));
    run(kOnFive);
    const auto mark = testing::ElementsAre(0x3f, 0x22, 0xb4, 0xf4);
    EXPECT_THAT(told(), mark);
    (void)ask(MessageType::SetVariables, {7, kProgramAt, 1, 1});
    EXPECT_THAT(told(), mark);
    (void)ask(MessageType::WriteBytecode, {7});
    restart();
    EXPECT_THAT(told(), mark);
}

TEST_F(NodeOfABoard, AProgramThatComesWhileAnotherIsSavedIsNotMixedWithIt) {
    run(kOnFive);
    (void)ask(MessageType::WriteBytecode, {7});
    Words other = kOnFive;
    other[3] = instruction(Opcode::SmallImm, 99);
    Words words{7, 0};
    words.insert(words.end(), other.begin(), other.end());
    for (const uint8_t byte : bytes_of(command(MessageType::WriteBytecode, {7})))
        board::on_byte(byte);
    for (const uint8_t byte : bytes_of(command(MessageType::SetBytecode, words)))
        board::on_byte(byte);
    for (const uint8_t byte : bytes_of(command(MessageType::Run, {7}))) board::on_byte(byte);
    turn(board->firmware);
    ASSERT_TRUE(board->firmware.store.is_saving);
    turn(board->firmware);
    ASSERT_FALSE(board->firmware.store.is_saving);
    restart();
    board->hear(event(3, 5, {}));
    EXPECT_EQ(variable(kUser), 11);
}

TEST_F(NodeOfABoard, TakesTheNumberThatWasWrittenAndSaved) {
    (void)ask(MessageType::SetVariables, {7, 0, 1234});
    (void)ask(MessageType::WriteBytecode, {7});
    EXPECT_EQ(ask(MessageType::ListNodes, {5}).at(0).source, 7);
    restart();
    EXPECT_EQ(ask(MessageType::ListNodes, {5}).at(0).source, 1234);
}

TEST_F(NodeOfABoard, KeepsItsNumberWhenNoneCanBeMeant) {
    for (const uint16_t wrong : {uint16_t{0}, uint16_t{0xffff}}) {
        (void)ask(MessageType::SetVariables, {7, 0, wrong});
        (void)ask(MessageType::WriteBytecode, {7});
        restart();
        EXPECT_EQ(ask(MessageType::ListNodes, {5}).at(0).source, 7);
    }
}

TEST_F(NodeOfABoard, RestartsBehindTheSave) {
    load(kOnFive);
    for (const uint8_t byte : bytes_of(command(MessageType::WriteBytecode, {7})))
        board::on_byte(byte);
    board->hear(command(MessageType::Reboot, {7}));
    EXPECT_EQ(board->restarts, 1);
    restart();
    board->hear(event(3, 5, {}));
    EXPECT_EQ(variable(kUser), 11);
}

// The line is slower than the script: events are dropped and counted, the count can be read, and a
// host is obeyed and gets its answers first.
TEST_F(NodeOfABoard, AScriptThatEmitsWithoutEndCanBeStopped) {
    const auto turn_slowly = [&] {
        turn(board->firmware);
        uint8_t byte = 0;
        if (board::next_byte(byte)) board->sent.push_back(byte);
    };
    const auto hear_slowly = [&](MessageType type) {
        for (const uint8_t byte : bytes_of(command(type, {7}))) board::on_byte(byte);
        for (int i = 0; i < 200; ++i) turn_slowly();
    };
    load(kEmitsForever);
    hear_slowly(MessageType::Run);
    ASSERT_TRUE(vm::is_active(board->firmware.node.vm));
    EXPECT_GT(static_cast<uint16_t>(variable(kDroppedAt)), 500);
    board->sent.clear();
    hear_slowly(MessageType::Stop);
    EXPECT_FALSE(vm::is_active(board->firmware.node.vm));
    EXPECT_EQ(count(board->said(), type_of(MessageType::ExecutionStateChanged)), 1);
}

TEST_F(NodeOfABoard, CommandsWaitForRoom) {
    board->stuck = true;
    for (int i = 0; i < 20; ++i) {
        for (const uint8_t byte : bytes_of(command(MessageType::GetExecutionState, {7})))
            board::on_byte(byte);
    }
    for (int i = 0; i < 100; ++i) turn(board->firmware);
    board->stuck = false;
    board->settle();
    EXPECT_EQ(count(board->said(), type_of(MessageType::ExecutionStateChanged)), 20);
    EXPECT_EQ(variable(kDroppedAt), 0);
}

// Other nodes are described at the same time: their frames are many, and none of ours.
TEST_F(NodeOfABoard, WhatIsForOthersIsReadWhileAnAnswerIsUnderWay) {
    run(kOnFive);
    for (const uint8_t byte : bytes_of(command(MessageType::GetNodeDescription, {7, 5})))
        board::on_byte(byte);
    for (int i = 0; i < 100; ++i) {
        for (const uint8_t byte : bytes_of(event(9, 0x9003, Words(40, 1)))) board::on_byte(byte);
        turn(board->firmware);
    }
    board->hear(event(3, 5, {}));
    EXPECT_EQ(board->firmware.receiver.lost.load(), 0);
    EXPECT_EQ(count(board->said(), 0x9003), 30);
    EXPECT_EQ(variable(kUser), 11);
}

TEST_F(NodeOfABoard, TheTimerFiresOncePerPeriod) {
    // onevent timer: variable 44 += 1
    run({3, isa::kLocalEventFirst, 3, instruction(Opcode::Load, kUser),
         instruction(Opcode::SmallImm, 1), instruction(Opcode::Binary, 2),
         instruction(Opcode::Store, kUser), instruction(Opcode::Stop, 0)});
    (void)ask(MessageType::SetVariables, {7, kPeriodAt, 20});
    board->wait_ms(100);
    EXPECT_EQ(variable(kUser), 5);
    (void)ask(MessageType::SetVariables, {7, kPeriodAt, 0});
    board->wait_ms(100);
    EXPECT_EQ(variable(kUser), 5);
}

TEST_F(NodeOfABoard, ButtonsAndLampsAreVariables) {
    // onevent buttons: leds = buttons
    run({3, static_cast<uint16_t>(isa::kLocalEventFirst - kButtonsEvent), 3,
         instruction(Opcode::Load, kButtonsAt), instruction(Opcode::Store, kLedsAt),
         instruction(Opcode::Stop, 0)});
    board->buttons = 2;
    board->settle();
    board->settle();
    EXPECT_EQ(board->leds, 2);
}

}  // namespace
}  // namespace vagus::firmware
