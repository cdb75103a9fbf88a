#include "sim/frame_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/rng.hpp"

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
    constexpr uint32_t kLast = kFramesOnTheirWay + 1;
    EXPECT_EQ(numbers.find({frame(2, 2)}, kLast - 1), kLast);
}

// Sixty thousand equal ones would be gone through for each frame that is received.
TEST(FrameNumbers, OfMoreEqualFramesThanTheLimitTheOldestIsNotFound) {
    FrameNumbers numbers;
    for (size_t i = 0; i < kEqualFramesMax; ++i) numbers.sent({frame(1, 1)}, 0);
    EXPECT_EQ(numbers.find({frame(1, 1)}, 0), 1u);
    numbers.sent({frame(1, 1)}, 0);
    EXPECT_EQ(numbers.find({frame(1, 1)}, 0), 2u);
}

// Many kinds of frames come and go; compared with a plain list of all.
TEST(FrameNumbers, AreThoseOfASearchThroughAll) {
    SplitMix64 random(7);
    FrameNumbers numbers;
    std::vector<std::pair<uint8_t, uint16_t>> sent;
    for (size_t i = 0; i < 2 * kFramesOnTheirWay; ++i) {
        // Those of a sender are of its time: older ones are forgotten whole.
        const auto source = static_cast<uint16_t>(i / 500 + random.next() % 3);
        const auto byte = static_cast<uint8_t>(random.next() % 200);
        ASSERT_EQ(numbers.sent({frame(source, byte)}, 0), i + 1) << "seed 7";
        sent.emplace_back(byte, source);
        if (i % 97 != 0) continue;
        const size_t from = i - std::min<size_t>(i, random.next() % 3000);
        const auto found = std::find(sent.begin() + static_cast<std::ptrdiff_t>(from), sent.end(),
                                     std::pair(byte, source));
        ASSERT_EQ(numbers.find({frame(source, byte)}, static_cast<uint32_t>(from)),
                  static_cast<size_t>(found - sent.begin()) + 1)
            << "seed 7, frame " << i;
    }
    EXPECT_EQ(numbers.find({frame(sent.front().second, sent.front().first)}, 0), 0u);
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
    constexpr uint32_t kLast = kFramesOnTheirWay + 2;
    EXPECT_EQ(numbers.find({frame(2, 2)}, kLast - 1), kLast);
}

}  // namespace
}  // namespace vagus::sim
