// The saved program: its form in the slots, and that no loss of power, at whatever byte, makes a
// piece of one run.
#include "firmware/node/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "firmware/board.hpp"
#include "firmware/node/fake_board.hpp"

namespace vagus::firmware {
namespace {

using Words = std::vector<uint16_t>;
using testing::AnyOf;
using testing::ElementsAre;

constexpr uint32_t kMark = 0x12345678;

struct Program {
    uint16_t id = 0;
    Words words;
    bool operator==(const Program&) const = default;
};

void put_bytecode(const Words& words) {
    std::copy(words.begin(), words.end(), board::kMachine.bytecode);
}

void save(TestSlots& slots, const Program& program) {
    TestBoard board(slots);
    board::begin();
    Store store{};
    uint32_t mark = 0;
    (void)load(store, mark);
    board::begin();
    put_bytecode(program.words);
    begin_save(store, program.id, kMark);
    while (!save_step(store)) {
    }
}

// Without the zeros behind its last word.
Program loaded(TestSlots& slots) {
    TestBoard board(slots);
    board::begin();
    Store store{};
    uint32_t mark = 0;
    Program program{.id = load(store, mark), .words = {}};
    EXPECT_EQ(mark, program.id == 0 ? 0 : kMark);
    if (board::kMachine.bytecode[0] == 0) return program;
    program.words.assign(board::kMachine.bytecode, board::kMachine.bytecode + kTestBytecode);
    while (!program.words.empty() && program.words.back() == 0) program.words.pop_back();
    return program;
}

Program program_of(uint16_t id, uint16_t size, uint16_t first) {
    Program program{.id = id, .words = Words(size)};
    std::iota(program.words.begin(), program.words.end(), first);
    return program;
}

TEST(Store, AnEmptySlotHoldsNoProgram) {
    TestSlots slots;
    EXPECT_EQ(loaded(slots), Program{});
}

// All bytes are inverted. The checksum was computed by another program: zlib's crc32 over number,
// id, mark and 600 words.
TEST(Store, ASlotLooksAsDocumented) {
    TestSlots slots;
    save(slots, {.id = 7, .words = {3, 0xffff, 3}});
    const auto& slot = slots.bytes[0];
    EXPECT_THAT(std::vector<uint8_t>(slot.begin(), slot.begin() + 16),
                ElementsAre(0xfe, 0xff, 0xf8, 0xff, 0x87, 0xa9, 0xcb, 0xed, 0xfc, 0xff, 0x00, 0x00,
                            0xfc, 0xff, 0xff, 0xff));
    EXPECT_THAT(std::vector<uint8_t>(slot.end() - 8, slot.end()),
                ElementsAre(0xff, 0xff, 0xff, 0xff, 0x0a, 0x45, 0x1f, 0xb3));
}

TEST(Store, TheLaterOfTwoProgramsCounts) {
    TestSlots slots;
    for (uint16_t i = 1; i <= 5; ++i) {
        const Program program = program_of(i, 20, static_cast<uint16_t>(100 * i));
        save(slots, program);
        EXPECT_EQ(loaded(slots), program) << i;
    }
}

TEST(Store, TheNumberOfASlotMayWrap) {
    TestSlots slots;
    save(slots, program_of(1, 3, 1));
    // By hand: number 0xffff instead of 1, and the checksum that belongs to it.
    slots.bytes[0][0] = 0;
    slots.bytes[0][1] = 0;
    const uint8_t checksum[] = {0x6d, 0x2a, 0x68, 0xad};
    std::copy(std::begin(checksum), std::end(checksum), slots.bytes[0].end() - 4);
    ASSERT_EQ(loaded(slots), program_of(1, 3, 1));
    save(slots, program_of(2, 3, 50));
    EXPECT_EQ(loaded(slots), program_of(2, 3, 50));
}

TEST(Store, AProgramThatFillsTheBytecodeIsKept) {
    TestSlots slots;
    const Program whole = program_of(1, kTestBytecode, 1);
    save(slots, whole);
    EXPECT_EQ(loaded(slots), whole);
}

// A memory that can be written only once, or slowly, is spared.
TEST(Store, WhatIsZeroStaysAsItWasErased) {
    TestSlots slots;
    save(slots, {.id = 1, .words = {3, 0xffff, 3}});
    const auto& slot = slots.bytes[0];
    EXPECT_TRUE(
        std::all_of(slot.begin() + 14, slot.end() - 4, [](uint8_t byte) { return byte == 0xff; }));
}

// At every byte that a save writes the power may go: what then starts is the program from before or
// the new one.
TEST(Store, PowerThatGoesAtAnyByteLeavesOneWholeProgram) {
    const Program old = program_of(3, 41, 1000), next = program_of(4, 40, 2000);
    TestSlots before;
    save(before, program_of(9, 50, 5));
    save(before, old);
    TestSlots measured = before;
    save(measured, next);
    const size_t writes = measured.writes - before.writes;
    ASSERT_EQ(writes, 4u + kTestSlotBytes);  // the begin is erased, then all is written
    for (size_t left = 0; left <= writes; ++left) {
        TestSlots slots = before;
        slots.writes_left = left;
        save(slots, next);
        slots.writes_left.reset();
        EXPECT_THAT(loaded(slots), AnyOf(old, next)) << left;
        save(slots, next);
        EXPECT_EQ(loaded(slots), next) << left << ": and it can be saved again";
    }
}

TEST(Store, PowerThatGoesInTheFirstSaveLeavesNoProgram) {
    const Program only = program_of(3, 11, 1000);
    for (size_t left = 0; left < 4 + kTestSlotBytes; ++left) {
        TestSlots slots;
        slots.writes_left = left;
        save(slots, only);
        EXPECT_EQ(loaded(slots), Program{}) << left;
    }
}

TEST(Store, AFlippedBitAnywhereBringsBackTheProgramFromBefore) {
    const Program old = program_of(3, 8, 1000), next = program_of(4, 8, 2000);
    TestSlots good;
    save(good, old);
    save(good, next);
    for (size_t bit = 0; bit < 8 * kTestSlotBytes; ++bit) {
        TestSlots slots = good;
        slots.bytes[1][bit / 8] = static_cast<uint8_t>(slots.bytes[1][bit / 8] ^ (1 << bit % 8));
        EXPECT_EQ(loaded(slots), old) << "bit " << bit;
    }
}

TEST(Store, ASaveThatIsGivenUpChangesNothing) {
    TestSlots slots;
    save(slots, program_of(1, 10, 7));
    {
        TestBoard board(slots);
        Store store{};
        board::begin();
        uint32_t mark = 0;
        (void)load(store, mark);
        put_bytecode(Words(10, 99));
        begin_save(store, 2, kMark);
        (void)save_step(store);
        end_save(store);
        EXPECT_FALSE(store.is_saving);
    }
    EXPECT_EQ(loaded(slots), program_of(1, 10, 7));
}

}  // namespace
}  // namespace vagus::firmware
