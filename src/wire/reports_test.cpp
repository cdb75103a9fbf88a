// Frames by hand from docs/spec/aseba-wire-and-vm.md, section 2.2.
#include "wire/reports.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vagus::wire {
namespace {

Frame frame_of(uint16_t type, const std::vector<uint8_t>& payload) {
    Frame frame{};
    frame.source = 1;
    frame.type = type;
    for (const uint8_t byte : payload) frame.payload[frame.size++] = byte;
    return frame;
}

std::string text_of(const Fault& fault) {
    char text[kFaultTextMax];
    return {text, write_fault_text(fault, text)};
}

TEST(Reports, AnEventHasWholeWordsAsArguments) {
    const Frame event = frame_of(4, {5, 0, 0xf8, 0xff, 9});
    EXPECT_EQ(argument_count(event), 2);
    EXPECT_EQ(argument(event, 1), -8);
    EXPECT_EQ(arguments_of<std::vector<int16_t>>(event), (std::vector<int16_t>{5, -8}));
}

TEST(Reports, ArgumentsAreAddedBehindThoseThatAreThere) {
    Frame event = frame_of(4, {});
    add_argument(event, 5);
    add_argument(event, -8);
    EXPECT_EQ(event.size, 4);
    EXPECT_EQ(arguments_of<std::vector<int16_t>>(event), (std::vector<int16_t>{5, -8}));
}

TEST(Reports, EachFaultHasItsKindPlaceAndSentence) {
    Fault fault;
    ASSERT_TRUE(read_fault(frame_of(0x9006, {7, 0, 3, 0, 0xff, 0xff}), fault));
    EXPECT_EQ(fault.kind, FaultKind::ArrayAccess);
    EXPECT_EQ(fault.pc, 7);
    EXPECT_EQ(text_of(fault), "array access out of bounds: index -1 in an array of 3");
    ASSERT_TRUE(read_fault(frame_of(0x9006, {7, 0}), fault));  // of a deque
    EXPECT_EQ(text_of(fault), "array access out of bounds");
    ASSERT_TRUE(read_fault(frame_of(0x9007, {0x0c, 0}), fault));
    EXPECT_EQ(fault.kind, FaultKind::DivisionByZero);
    EXPECT_EQ(fault.pc, 12);
    EXPECT_EQ(text_of(fault), "division by zero");
    ASSERT_TRUE(read_fault(frame_of(0x9008, {1, 0}), fault));
    EXPECT_EQ(fault.kind, FaultKind::Killed);
    const Frame hot = frame_of(0x9009, {1, 0, 3, 'h', 'o', 't'});  // the text stays in it
    ASSERT_TRUE(read_fault(hot, fault));
    EXPECT_EQ(fault.kind, FaultKind::NodeSpecific);
    EXPECT_EQ(text_of(fault), "hot");
}

TEST(Reports, TheLongestSentencesFit) {
    Fault fault;
    ASSERT_TRUE(read_fault(frame_of(0x9006, {7, 0, 0xff, 0xff, 0, 0x80}), fault));
    EXPECT_EQ(text_of(fault), "array access out of bounds: index -32768 in an array of 65535");
    std::vector<uint8_t> longest{1, 0, 255};
    longest.resize(3 + 255, 'x');
    const Frame frame = frame_of(0x9009, longest);
    ASSERT_TRUE(read_fault(frame, fault));
    EXPECT_EQ(text_of(fault), std::string(255, 'x'));
}

TEST(Reports, WhatIsNoFaultOrMalformedIsRefused) {
    Fault fault;
    EXPECT_FALSE(read_fault(frame_of(0x900a, {1, 0, 0, 0}), fault));
    EXPECT_FALSE(read_fault(frame_of(0x9007, {1}), fault));
    EXPECT_FALSE(read_fault(frame_of(0x9009, {1, 0, 3, 'h'}), fault));
    EXPECT_FALSE(read_fault(frame_of(4, {1, 0}), fault));
}

}  // namespace
}  // namespace vagus::wire
