// The saved program: its form in the slots, and that no loss of power, at whatever byte, makes a
// piece of one run.
#include "firmware/node/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "firmware/board.hpp"
#include "firmware/node/fake_board.hpp"

namespace vagus::firmware {
namespace {

using Words = std::vector<uint16_t>;
using testing::AnyOf;
using testing::ElementsAre;

struct Program {
    uint16_t id = 0;
    Words words;
    bool operator==(const Program&) const = default;
};

void put_bytecode(const Words& words) {
    std::copy(words.begin(), words.end(), board::kMemory.bytecode);
}

void save(TestSlots& slots, const Program& program) {
    TestBoard board(slots);
    board::begin();
    Store store{};
    (void)load(store);
    board::begin();
    put_bytecode(program.words);
    begin_save(store, program.id);
    while (!save_step(store)) {
    }
}

// Without the zeros behind its last word.
Program loaded(TestSlots& slots) {
    TestBoard board(slots);
    board::begin();
    Store store{};
    Program program{.id = load(store), .words = {}};
    program.words.assign(board::kMemory.bytecode, board::kMemory.bytecode + kTestBytecode);
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

// The checksum was computed by another program: zlib's crc32 over all bytes before it.
TEST(Store, ASlotLooksAsDocumented) {
    TestSlots slots;
    save(slots, {.id = 7, .words = {3, 0xffff, 3}});
    const std::vector<uint8_t> begin(slots.bytes[0].begin(), slots.bytes[0].begin() + 20);
    EXPECT_THAT(begin, ElementsAre(1, 0, 7, 0, 2, 0, 0x42, 0x76, 3, 0, 0xff, 0xff, 3, 0, 0, 0, 0x14, 0x47, 0x49, 0x60));
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
    slots.bytes[0][0] = 0xff;
    slots.bytes[0][1] = 0xff;
    const uint32_t checksum = 0x068c8758;
    for (size_t i = 0; i < 4; ++i)
        slots.bytes[0][16 + i] = static_cast<uint8_t>(checksum >> (8 * i));
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

// By hand: a header that says so.
TEST(Store, AProgramLargerThanTheBytecodeIsNotLoaded) {
    TestSlots slots;
    save(slots, program_of(1, kTestBytecode, 1));
    slots.bytes[0][4] = (kTestBytecode / 2 + 1) & 0xff;
    slots.bytes[0][5] = (kTestBytecode / 2 + 1) >> 8;
    EXPECT_EQ(loaded(slots), Program{});
}

TEST(Store, ZerosBehindTheLastWordAreNotWritten) {
    TestSlots slots;
    save(slots, {.id = 1, .words = {3, 0xffff, 3, 0, 0, 0}});
    EXPECT_EQ(slots.writes, 12u + 8 + 8 + 4);  // erased, the header, two pairs, the checksum
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
    ASSERT_EQ(writes, 12u + 8u + 80u + 4u);  // erased, the header, 20 pairs of words, the checksum
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
    for (size_t left = 0; left < 12 + 8 + 24 + 4; ++left) {
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
    for (size_t bit = 0; bit < 8 * (12 + 16); ++bit) {
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
        (void)load(store);
        put_bytecode(Words(10, 99));
        begin_save(store, 2);
        (void)save_step(store);
        end_save(store);
        EXPECT_FALSE(store.is_saving);
    }
    EXPECT_EQ(loaded(slots), program_of(1, 10, 7));
}

}  // namespace
}  // namespace vagus::firmware
