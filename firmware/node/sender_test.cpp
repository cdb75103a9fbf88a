#include "firmware/node/sender.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/node/fake_board.hpp"

namespace vagus::firmware {
namespace {

using Words = std::vector<uint16_t>;

bool queue(Sender& sender, const wire::Frame& frame) {
    begin_message(sender, frame.source, frame.type);
    for (uint16_t i = 0; i < frame.size; ++i) put_byte(sender, frame.payload[i]);
    return end_message(sender);
}

std::vector<uint16_t> types_of(Sender& sender) {
    std::vector<uint16_t> types;
    wire::FrameReader reader;
    for (uint8_t byte = 0; take_byte(sender, byte);) {
        reader.feed(&byte, 1);
        if (reader.complete()) types.push_back(reader.frame().type);
    }
    return types;
}

wire::Frame message(size_t words) {
    return event(1, 0x9005, Words(words, 0xabcd));
}

TEST(Sender, GivesTheBytesOfAFrame) {
    Sender sender{};
    ASSERT_TRUE(queue(sender, event(3, 0x0102, {0x0304})));
    std::vector<uint8_t> bytes;
    for (uint8_t byte = 0; take_byte(sender, byte);) bytes.push_back(byte);
    EXPECT_EQ(bytes, (std::vector<uint8_t>{2, 0, 3, 0, 2, 1, 4, 3}));
}

TEST(Sender, KeepsTheOrder) {
    Sender sender{};
    ASSERT_TRUE(queue(sender, event(1, 7, {})));
    ASSERT_TRUE(queue(sender, message(1)));
    ASSERT_TRUE(queue(sender, event(1, 8, {})));
    EXPECT_EQ(types_of(sender), (Words{7, 0x9005, 8}));
}

// Events take 127 of the 255 bytes: 12 frames of 10.
TEST(Sender, EventsWithoutEndLeaveRoomForMessages) {
    Sender sender{};
    for (uint16_t i = 0; i < 12; ++i) ASSERT_TRUE(queue(sender, event(1, i, {1, 2}))) << i;
    EXPECT_FALSE(queue(sender, event(1, 99, {1, 2})));
    ASSERT_TRUE(has_room(sender, kRoomOfMessages));
    ASSERT_TRUE(queue(sender, message(60)));
    EXPECT_EQ(types_of(sender), (Words{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0x9005}));
}

// 255 bytes: 6 and 124 words, one byte over.
TEST(Sender, MessagesMayFillTheRing) {
    Sender sender{};
    EXPECT_FALSE(queue(sender, message(125)));
    ASSERT_TRUE(has_room(sender, 255));
    ASSERT_TRUE(queue(sender, message(124)));
    EXPECT_FALSE(queue(sender, message(0)));
    EXPECT_FALSE(has_room(sender, 6));
    EXPECT_EQ(types_of(sender), Words{0x9005});
}

// The longest event that ever fits has 127 bytes: 6 and 60 words, one byte over.
TEST(Sender, AnEventLongerThanItsRoomIsDropped) {
    Sender sender{};
    EXPECT_TRUE(queue(sender, event(1, 1, Words(60, 0))));
    EXPECT_EQ(types_of(sender), Words{1});
    EXPECT_FALSE(queue(sender, event(1, 2, Words(61, 0))));
    EXPECT_FALSE(queue(sender, event(1, 3, Words(258, 0))));
    EXPECT_EQ(types_of(sender), Words{});
}

TEST(Sender, AMessageThatIsBegunAnewIsNotSent) {
    Sender sender{};
    begin_message(sender, 1, 0x9003);
    put_byte(sender, 7);
    ASSERT_TRUE(queue(sender, message(1)));
    EXPECT_EQ(types_of(sender), Words{0x9005});
}

TEST(Sender, NothingOfAMessageIsSentBeforeItsEnd) {
    Sender sender{};
    begin_message(sender, 1, 0x9003);
    put_byte(sender, 7);
    uint8_t byte = 0;
    EXPECT_FALSE(take_byte(sender, byte));
    ASSERT_TRUE(end_message(sender));
    EXPECT_TRUE(take_byte(sender, byte));
}

TEST(Sender, TheRingGoesRound) {
    Sender sender{};
    for (uint16_t i = 0; i < 1000; ++i) {
        ASSERT_TRUE(queue(sender, event(1, i, {i, 5, 6})));
        ASSERT_EQ(types_of(sender), Words{i});
    }
}

}  // namespace
}  // namespace vagus::firmware
