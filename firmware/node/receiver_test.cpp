// Frames out of a line that loses, flips and invents bytes.
#include "firmware/node/receiver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "firmware/node/fake_board.hpp"

namespace vagus::firmware {
namespace {

using Bytes = std::vector<uint8_t>;
using Types = std::vector<uint16_t>;
using wire::MessageType;

constexpr uint32_t kSecond_ms = 1000;

uint16_t low_half(uint32_t milliseconds) {
    return static_cast<uint16_t>(milliseconds);
}

Bytes without(const Bytes& bytes, size_t lost) {
    Bytes rest;
    for (size_t i = 0; i < bytes.size(); ++i) {
        if (i != lost) rest.push_back(bytes[i]);
    }
    return rest;
}

class Line : public testing::Test {
protected:
    void put(const Bytes& bytes) {
        for (const uint8_t byte : bytes) receive_byte(receiver, byte);
    }
    void put(const wire::Frame& whole) { put(bytes_of(whole)); }
    // Types of the frames that are there now.
    std::vector<uint16_t> types() {
        std::vector<uint16_t> types;
        while (next_frame(receiver, low_half(now_ms))) {
            const Received frame = front(receiver);
            types.push_back(frame.type);
            last_type = frame.type;
            source = frame.source;
            words.assign(frame.words, frame.words + frame.count);
            drop_front(receiver, low_half(now_ms));
        }
        return types;
    }
    std::vector<uint16_t> types_after(uint32_t milliseconds) {
        std::vector<uint16_t> all;
        for (uint32_t i = 0; i < milliseconds; ++i) {
            ++now_ms;
            for (const uint16_t type : types()) all.push_back(type);
        }
        return all;
    }

    TestSlots slots;
    TestBoard board{slots};
    Receiver receiver{};
    uint32_t now_ms = 0;
    // Of the last frame.
    uint16_t source = 0;
    Types words;
    uint16_t last_type = 0;
};

constexpr uint16_t kRun = 0xa003, kSetBytecode = 0xa001, kListNodes = 0xa011;

wire::Frame run_command() {
    return command(MessageType::Run, {7});
}

TEST_F(Line, AFrameIsThereWithItsLastByte) {
    const Bytes bytes = bytes_of(event(3, 5, {1000, 0xffff}));
    for (size_t i = 0; i + 1 < bytes.size(); ++i) {
        put(Bytes{bytes[i]});
        EXPECT_EQ(types(), Types{}) << i;
    }
    put(Bytes{bytes.back()});
    ASSERT_EQ(types(), Types{5});
    EXPECT_EQ(source, 3);
    EXPECT_EQ(words, (Types{1000, 0xffff}));
}

TEST_F(Line, TheLongestFrameFits) {
    put(command(MessageType::SetBytecode, Types(kWordsMax, 7)));
    put(run_command());
    EXPECT_EQ(types(), (Types{kSetBytecode, kRun}));
}

TEST_F(Line, AHeaderWithMoreThanTheLongestPayloadIsNone) {
    put(Bytes{0x06, 0x02, 0x00, 0x00, 0x03, 0xa0});  // 518 bytes
    put(run_command());
    put(run_command());
    EXPECT_EQ(types(), (Types{kRun, kRun}));
    EXPECT_EQ(receiver.skipped, 6);
}

TEST_F(Line, AFrameStaysInFrontWithAllBehindIt) {
    put(event(3, 5, {1}));
    put(event(3, 6, {}));
    for (int i = 0; i < 3; ++i) {
        now_ms += kSecond_ms;
        ASSERT_TRUE(next_frame(receiver, low_half(now_ms)));
        EXPECT_EQ(front(receiver).type, 5);
    }
    EXPECT_EQ(types(), (Types{5, 6}));
}

// A host writes the flash of another node: its commands (section 2.4) are frames here, too.
TEST_F(Line, CommandsToABootLoaderAreFrames) {
    put(event(0, 0x8002, {9, 0, 0}));
    put(event(9, 0x8006, {0}));
    put(run_command());
    EXPECT_EQ(types(), (Types{0x8002, 0x8006, kRun}));
}

// The next frame then begins at an odd place.
TEST_F(Line, AFrameOfOddSizeIsAFrame) {
    const Bytes name{4, 0, 9, 0, 1, 0x90, 1, 0, 1, 'a', 3, 0, 9, 0, 1, 0x90, 1, 0, 0};
    put(name);
    put(event(3, 5, {1000}));
    EXPECT_EQ(types(), (Types{0x9001, 0x9001, 5}));
    EXPECT_EQ(words, Types{1000});
}

TEST_F(Line, BytecodeWaitsForAWitness) {
    put(command(MessageType::SetBytecode, {7, 0, 3, 0xffff, 3, 0}));
    EXPECT_EQ(types(), Types{});
    put(run_command());
    EXPECT_EQ(types(), (Types{kSetBytecode, kRun}));
}

TEST_F(Line, SilenceIsAWitness) {
    put(command(MessageType::SetBytecode, {7, 0, 3, 0xffff, 3, 0}));
    EXPECT_EQ(types_after(kWitness_ms - 1), Types{});
    EXPECT_EQ(types_after(2), Types{kSetBytecode});
}

TEST_F(Line, EventZeroOfAHostIsAFrame) {
    put(event(0, 0, {}));
    EXPECT_EQ(types_after(kWitness_ms + 1), Types{0});
    put(event(0, 0, {}));
    put(run_command());
    EXPECT_EQ(types(), (Types{0, kRun}));
}

TEST_F(Line, ZerosBehindABadByteAreNoFrames) {
    put(Bytes{0xff, 0xff, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(types_after(kSecond_ms), Types{});
    put(run_command());
    EXPECT_EQ(types(), Types{kRun});
}

// Whatever byte of it is lost: it takes bytes of the next frame instead, and what follows it
// is no header.
TEST_F(Line, BytecodeThatLostAByteIsNotGiven) {
    const Bytes whole =
        bytes_of(command(MessageType::SetBytecode, {7, 0, 3, 0xffff, 3, 0x4001, 0x4002, 0}));
    for (size_t lost = 0; lost < whole.size(); ++lost) {
        receiver = Receiver{};
        put(without(whole, lost));
        put(run_command());
        put(command(MessageType::ListNodes, {5}));
        const Types all = types_after(kSecond_ms);
        EXPECT_EQ(std::count(all.begin(), all.end(), kSetBytecode), 0) << lost;
        EXPECT_EQ(all.back(), kListNodes) << lost;
    }
}

// The link is pulled at any moment of an upload, and put in again.
TEST_F(Line, BytecodeThatWasCutOffIsNotGiven) {
    const Bytes whole = bytes_of(command(MessageType::SetBytecode, Types(40, 7)));
    for (size_t size = 1; size < whole.size(); ++size) {
        receiver = Receiver{};
        put(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
        EXPECT_EQ(types_after(kBroken_ms + 1), Types{}) << size;
        put(command(MessageType::ListNodes, {5}));
        EXPECT_EQ(types_after(kWitness_ms + 1), Types{kListNodes}) << size;
    }
}

// A header that noise made, or a frame that was cut off, and a host that asks each 100 ms: it is
// heard within a second, although the line is never silent for long.
TEST_F(Line, AFrameThatTakesTooLongIsNone) {
    put(Bytes{0xfe, 0x01, 3, 0, 5, 0});  // an event of 510 bytes
    Types all;
    for (int i = 0; i < 10; ++i) {
        put(command(MessageType::ListNodes, {5}));
        for (const uint16_t type : types_after(100)) all.push_back(type);
    }
    EXPECT_FALSE(all.empty());
    EXPECT_EQ(std::count(all.begin(), all.end(), kListNodes), static_cast<long>(all.size()));
}

TEST_F(Line, APauseWithinAFrameIsNoEnd) {
    const Bytes bytes = bytes_of(event(3, 5, {1000}));
    put(Bytes(bytes.begin(), bytes.begin() + 3));
    EXPECT_EQ(types_after(kBroken_ms - 1), Types{});
    put(Bytes(bytes.begin() + 3, bytes.end()));
    EXPECT_EQ(types(), Types{5});
}

// An event that few send is one, too, when it is alone or among others.
TEST_F(Line, UnlikelyEventsComeLater) {
    put(event(40000, 5, Types(40, 1)));
    EXPECT_EQ(types(), Types{});
    EXPECT_EQ(types_after(kWitness_ms + 1), Types{5});
    put(event(40000, 0x7fff, {}));
    put(run_command());
    EXPECT_EQ(types(), (Types{0x7fff, kRun}));
}

TEST_F(Line, WhatDoesNotFitIsCountedAndFoundAgain) {
    put(Bytes(kReceiveRoom + 10, 0xff));
    EXPECT_EQ(receiver.lost.load(), 10);
    EXPECT_EQ(types(), Types{});
    EXPECT_EQ(types_after(kSecond_ms), Types{});
    put(run_command());
    EXPECT_EQ(types_after(kWitness_ms + 1), Types{kRun});
}

// Noise of any kind and length, then a host that asks each 100 ms: it is heard within a second.
TEST_F(Line, AfterNoiseTheNextSecondOfGoodBytesIsHeard) {
    const unsigned seed = std::random_device{}();
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937 random(seed);
    constexpr int kRounds = 400;
    for (int round = 0; round < kRounds; ++round) {
        const size_t size = random() % 2000;
        for (size_t i = 0; i < size; ++i) {
            put(Bytes{static_cast<uint8_t>(random() % 4 == 0 ? 0 : random())});
            if (i % 8 == 0) (void)types_after(1);
        }
        Types all;
        for (int i = 0; i < 10; ++i) {
            put(command(MessageType::ListNodes, {5}));
            for (const uint16_t type : types_after(100)) all.push_back(type);
        }
        EXPECT_EQ(std::count(all.begin(), all.end(), kListNodes) > 0, true)
            << "seed " << seed << " round " << round;
    }
}

// One byte of a stream of frames is lost or has a flipped bit: of those behind it few are missed.
TEST_F(Line, OneBadByteCostsFewFrames) {
    Bytes stream;
    constexpr int kFrames = 100;
    for (uint16_t i = 0; i < kFrames; ++i) {
        for (const uint8_t byte : bytes_of(event(2, 1, {i, 300, 0}))) stream.push_back(byte);
    }
    for (size_t bad = 0; bad < 12; ++bad) {
        for (int bit = -1; bit < 8; ++bit) {
            receiver = Receiver{};
            Bytes bytes = stream;
            if (bit < 0) {
                bytes = without(bytes, bad);
            } else {
                bytes[bad] = static_cast<uint8_t>(bytes[bad] ^ (1 << bit));
            }
            for (size_t i = 0; i < bytes.size(); ++i) {
                put(Bytes{bytes[i]});
                if (i % 12 == 0) (void)types_after(1);
            }
            (void)types_after(kSecond_ms);
            ASSERT_EQ(last_type, 1) << bad << " " << bit;
            EXPECT_EQ(words.at(0), kFrames - 1) << bad << " " << bit;
        }
    }
}

}  // namespace
}  // namespace vagus::firmware
