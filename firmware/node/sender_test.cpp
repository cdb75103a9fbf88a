#include "firmware/node/sender.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/node/fake_board.hpp"

namespace vagus::firmware {
namespace {

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
    return event(1, 0x9005, std::vector<uint16_t>(words, 0xabcd));
}

TEST(Sender, GivesTheBytesOfAFrame) {
    Sender sender{};
    queue(sender, event(3, 0x0102, {0x0304}));
    std::vector<uint8_t> bytes;
    for (uint8_t byte = 0; take_byte(sender, byte);) bytes.push_back(byte);
    EXPECT_EQ(bytes, (std::vector<uint8_t>{2, 0, 3, 0, 2, 1, 4, 3}));
}

TEST(Sender, MessagesGoBeforeEventsThatWait) {
    Sender sender{};
    queue(sender, event(1, 7, {}));
    queue(sender, message(1));
    queue(sender, event(1, 8, {}));
    EXPECT_EQ(types_of(sender), (std::vector<uint16_t>{0x9005, 7, 8}));
}

TEST(Sender, AFrameThatHasBegunIsNotInterrupted) {
    Sender sender{};
    queue(sender, event(1, 7, {1, 2, 3}));
    uint8_t byte = 0;
    ASSERT_TRUE(take_byte(sender, byte));
    queue(sender, message(1));
    std::vector<uint8_t> rest;
    while (take_byte(sender, byte)) rest.push_back(byte);
    const std::vector<uint8_t> event_rest{0, 1, 0, 7, 0, 1, 0, 2, 0, 3, 0};
    ASSERT_EQ(rest.size(), event_rest.size() + 8);
    EXPECT_TRUE(std::equal(event_rest.begin(), event_rest.end(), rest.begin()));
}

// 127 bytes are room for 12 frames of 10.
TEST(Sender, EventsWithoutRoomAreDroppedWholeAndCounted) {
    Sender sender{};
    for (uint16_t i = 0; i < 15; ++i) queue(sender, event(1, i, {1, 2}));
    EXPECT_EQ(sender.dropped_events, 3);
    EXPECT_EQ(sender.dropped_messages, 0);
    EXPECT_EQ(types_of(sender), (std::vector<uint16_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
}

TEST(Sender, EventsWithoutEndLeaveRoomForMessages) {
    Sender sender{};
    for (uint16_t i = 0; i < 100; ++i) queue(sender, event(1, i, {1, 2}));
    ASSERT_TRUE(has_room(sender, 127));
    queue(sender, message(60));
    EXPECT_EQ(types_of(sender)[0], 0x9005);
}

// The longest frame that ever fits has 127 bytes: 6 and 60 words, one byte over.
TEST(Sender, AFrameLongerThanTheRingIsDropped) {
    Sender sender{};
    queue(sender, event(1, 1, std::vector<uint16_t>(60, 0)));
    queue(sender, event(1, 2, std::vector<uint16_t>(61, 0)));
    EXPECT_EQ(sender.dropped_events, 1);
    EXPECT_EQ(types_of(sender), std::vector<uint16_t>{1});
    queue(sender, event(1, 3, std::vector<uint16_t>(258, 0)));
    EXPECT_EQ(sender.dropped_events, 2);
}

TEST(Sender, TheRingGoesRound) {
    Sender sender{};
    for (uint16_t i = 0; i < 1000; ++i) {
        queue(sender, event(1, i, {i, 5, 6}));
        ASSERT_EQ(types_of(sender), std::vector<uint16_t>{i});
    }
}

}  // namespace
}  // namespace vagus::firmware
