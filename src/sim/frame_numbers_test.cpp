#include "sim/frame_numbers.hpp"

#include <gtest/gtest.h>

namespace vagus::sim {
namespace {

wire::Frame frame(uint16_t source, uint8_t byte) {
    return {1, source, 7, {byte}};
}

TEST(FrameNumbers, AFrameIsFoundByItsBytesTheOldestFirst) {
    FrameNumbers numbers;
    EXPECT_EQ(numbers.sent({frame(1, 5)}, 0), 1u);
    EXPECT_EQ(numbers.sent({frame(2, 5)}, 1), 2u);
    EXPECT_EQ(numbers.sent({frame(1, 5)}, 2), 3u);
    EXPECT_EQ(numbers.find({frame(1, 5)}, 0), 1u);
    EXPECT_EQ(numbers.find({frame(1, 5)}, 1), 3u);
    EXPECT_EQ(numbers.find({frame(1, 5)}, 3), 0u);
    EXPECT_EQ(numbers.find({frame(2, 5)}, 0), 2u);
    EXPECT_EQ(numbers.find({frame(3, 5)}, 0), 0u);
    EXPECT_EQ(numbers.cause_of(3), 2u);
    EXPECT_EQ(numbers.cause_of(1), 0u);
    EXPECT_EQ(numbers.cause_of(99), 0u);
}

TEST(FrameNumbers, ThoseThatAreTooOldAreNotFound) {
    FrameNumbers numbers;
    numbers.sent({frame(1, 1)}, 0);
    for (size_t i = 0; i + 1 < kFramesOnTheirWay; ++i) numbers.sent({frame(2, 2)}, 0);
    EXPECT_EQ(numbers.find({frame(1, 1)}, 0), 1u);
    numbers.sent({frame(2, 2)}, 0);
    EXPECT_EQ(numbers.find({frame(1, 1)}, 0), 0u);
    EXPECT_EQ(numbers.find({frame(2, 2)}, 0), 2u);
}

// Two robots with one script send the same at the same instant.
TEST(FrameNumbers, EqualFramesOfTwoBusesAreTwo) {
    FrameNumbers numbers;
    EXPECT_EQ(numbers.sent({frame(1, 5), 1}, 0), 1u);
    EXPECT_EQ(numbers.sent({frame(1, 5), 2}, 0), 2u);
    EXPECT_EQ(numbers.find({frame(1, 5), 2}, 0), 2u);
    EXPECT_EQ(numbers.find({frame(1, 5), 1}, 0), 1u);
    EXPECT_EQ(numbers.find({frame(1, 5), 0}, 0), 0u);
}

// What is no frame is found by nobody, and is forgotten in its turn.
TEST(FrameNumbers, SomethingElseHasANumberAndACause) {
    FrameNumbers numbers;
    EXPECT_EQ(numbers.sent({frame(1, 5)}, 0), 1u);
    EXPECT_EQ(numbers.other(1), 2u);
    EXPECT_EQ(numbers.cause_of(2), 1u);
    for (size_t i = 0; i < kFramesOnTheirWay; ++i) numbers.sent({frame(2, 2)}, 2);
    EXPECT_EQ(numbers.find({frame(1, 5)}, 0), 0u);
    EXPECT_EQ(numbers.find({frame(2, 2)}, 0), 3u);
}

}  // namespace
}  // namespace vagus::sim
