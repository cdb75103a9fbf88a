#include "hub/output_queue.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace vagus::hub {
namespace {

constexpr uint16_t kEventType = 7;
constexpr uint16_t kReply = 0x9005;

std::vector<uint8_t> frame(uint16_t type, uint16_t number, uint16_t payload = 2) {
    wire::Frame frame{};
    frame.source = number;
    frame.type = type;
    frame.size = payload;
    std::vector<uint8_t> bytes(wire::kFrameMax);
    bytes.resize(wire::encode(frame, bytes.data()));
    return bytes;
}

std::vector<uint16_t> sources(OutputQueue& queue) {
    std::vector<uint16_t> found;
    wire::Frame out;
    while (queue.pop(out)) found.push_back(out.source);
    return found;
}

// Everything that waits, as it would be written; all of it has left then.
std::vector<uint8_t> all_of(OutputQueue& queue) {
    std::vector<uint8_t> bytes;
    while (!queue.empty()) {
        const auto batch = queue.batch();
        bytes.insert(bytes.end(), batch.begin(), batch.end());
        queue.sent(batch.size());
    }
    return bytes;
}

void fill(OutputQueue& queue, uint16_t type) {
    for (size_t i = 0; i < kQueueFramesMax; ++i) queue.push(frame(type, static_cast<uint16_t>(i)));
}

TEST(OutputQueue, GivesTheBytesInTheOrderTheyCame) {
    OutputQueue queue;
    queue.push(frame(kEventType, 1, 0));
    queue.push(frame(kReply, 2, 1));
    const std::vector<uint8_t> expected{0, 0, 1, 0, 7, 0, 1, 0, 2, 0, 5, 0x90, 0};
    EXPECT_EQ(queue.frames(), 2u);
    EXPECT_EQ(all_of(queue), expected);
}

TEST(OutputQueue, AFrameOfWhichAPartHasLeftStillCounts) {
    OutputQueue queue;
    queue.push(frame(kEventType, 1));  // 8 bytes
    queue.push(frame(kEventType, 2));
    EXPECT_EQ(queue.batch().size(), 16u);
    queue.sent(3);
    EXPECT_EQ(queue.frames(), 2u);
    queue.sent(5);
    EXPECT_EQ(queue.frames(), 1u);
    queue.sent(8);
    EXPECT_EQ(queue.frames(), 0u);
    EXPECT_TRUE(queue.empty());
}

TEST(OutputQueue, OneFrameAboveTheLimitDropsTheOldestEventsInOnePass) {
    OutputQueue queue;
    fill(queue, kEventType);
    EXPECT_EQ(queue.frames(), kQueueFramesMax);
    EXPECT_EQ(queue.dropped(), (Dropped{0, 0}));
    queue.push(frame(kEventType, 0xabc));
    EXPECT_EQ(queue.dropped(), (Dropped{kDropFramesAtOnce, 0}));
    const std::vector<uint16_t> left = sources(queue);
    EXPECT_EQ(left.size(), kQueueFramesMax - kDropFramesAtOnce + 1);
    EXPECT_EQ(left.front(), kDropFramesAtOnce);
    EXPECT_EQ(left.back(), 0xabc);
}

TEST(OutputQueue, OneByteAboveTheLimitDropsToo) {
    OutputQueue queue;
    size_t bytes = 0;
    for (; bytes + wire::kFrameMax <= kQueueBytesMax; bytes += wire::kFrameMax) {
        queue.push(frame(kEventType, 1, wire::kPayloadMax));
    }
    const size_t rest = kQueueBytesMax - bytes;  // 262144 % 522 = 100
    ASSERT_EQ(rest, 100u);
    queue.push(frame(kEventType, 2, static_cast<uint16_t>(rest - wire::kHeaderSize)));
    EXPECT_EQ(queue.dropped(), (Dropped{0, 0}));
    EXPECT_EQ(queue.bytes(), kQueueBytesMax);
    queue.push(frame(kEventType, 3, 0));
    EXPECT_EQ(queue.dropped(), (Dropped{63, 0}));  // 63 * 522 >= 32768 > 62 * 522
}

TEST(OutputQueue, CommandsAndRepliesOutliveEventsAndKeepTheirOrder) {
    OutputQueue queue;
    for (size_t i = 0; i < kQueueFramesMax; ++i) {
        queue.push(frame(i % 64 == 0 ? kReply : kEventType, static_cast<uint16_t>(i / 64)));
    }
    for (int i = 0; i < 3; ++i) queue.push(frame(kReply, static_cast<uint16_t>(1000 + i)));
    EXPECT_EQ(queue.dropped(), (Dropped{kDropFramesAtOnce, 0}));
    std::vector<uint16_t> replies;
    wire::Frame out;
    while (queue.pop(out)) {
        if (out.type == kReply) replies.push_back(out.source);
    }
    std::vector<uint16_t> expected;
    for (uint16_t i = 0; i < kQueueFramesMax / 64; ++i) expected.push_back(i);
    expected.insert(expected.end(), {1000, 1001, 1002});
    EXPECT_EQ(replies, expected);
}

// ---- Stop passes everything ----

using Type = wire::MessageType;

// A command to a node; `number` in the place of the source tells it again.
std::vector<uint8_t> command(Type type, uint16_t node, uint16_t number) {
    wire::Frame frame{};
    frame.source = number;
    frame.type = static_cast<uint16_t>(type);
    frame.size = 4;
    frame.payload[0] = static_cast<uint8_t>(node & 0xff);
    frame.payload[1] = static_cast<uint8_t>(node >> 8);
    std::vector<uint8_t> bytes(wire::kFrameMax);
    bytes.resize(wire::encode(frame, bytes.data()));
    return bytes;
}

TEST(OutputQueue, StopAndWhatMakesANodeSafePassAll) {
    OutputQueue queue;
    queue.push(frame(kEventType, 1));
    queue.push(frame(kReply, 2));
    queue.push(command(Type::GetVariables, 9, 3));
    queue.push(command(Type::Stop, 9, 4));
    queue.push(command(Type::Run, 8, 5));
    queue.push(command(Type::SetVariables, 9, 6));
    queue.push(command(Type::GetVariables, 9, 7));
    EXPECT_EQ(sources(queue), (std::vector<uint16_t>{4, 6, 7, 1, 2, 3, 5}));
    EXPECT_EQ(queue.dropped(), Dropped{});
}

TEST(OutputQueue, WhatWouldActOnANodeIsDroppedByAStopThatIsNewer) {
    OutputQueue queue;
    const Type acts[] = {Type::SetBytecode, Type::Reset, Type::Run, Type::Step, Type::SetVariables};
    for (const Type type : acts) queue.push(command(type, 9, 1));
    queue.push(command(Type::Run, 8, 2));
    queue.push(command(Type::Stop, 9, 3));
    EXPECT_EQ(sources(queue), (std::vector<uint16_t>{3, 2}));
    EXPECT_EQ(queue.dropped(), (Dropped{0, 5}));
}

TEST(OutputQueue, WhatIsAskedAfterStopStaysBehindIt) {
    OutputQueue queue;
    queue.push(command(Type::Stop, 9, 1));
    queue.push(command(Type::Run, 9, 2));
    queue.push(command(Type::SetVariables, 9, 3));  // for the program that runs again
    EXPECT_EQ(sources(queue), (std::vector<uint16_t>{1, 2, 3}));
    queue.push(command(Type::Stop, 9, 1));
    queue.push(command(Type::Run, 9, 2));
    queue.push(command(Type::Stop, 9, 3));
    EXPECT_EQ(sources(queue).back(), 3);
}

TEST(OutputQueue, AFullQueueHasRoomForStop) {
    OutputQueue queue;
    fill(queue, kReply);
    queue.push(command(Type::Stop, 9, 1));
    queue.push(command(Type::SetVariables, 9, 2));
    wire::Frame out;
    ASSERT_TRUE(queue.pop(out));
    EXPECT_EQ(out.type, static_cast<uint16_t>(Type::Stop));
    ASSERT_TRUE(queue.pop(out));
    EXPECT_EQ(out.type, static_cast<uint16_t>(Type::SetVariables));
}

// Nobody makes it grow by saying Stop again and again, to one node or to many.
TEST(OutputQueue, ManyStopsTakeBoundedRoom) {
    OutputQueue queue;
    EXPECT_TRUE(queue.push(command(Type::Stop, 9, 1)));
    for (int i = 1; i < 1000; ++i) EXPECT_FALSE(queue.push(command(Type::Stop, 9, 1)));
    EXPECT_EQ(queue.frames(), 1u);
    EXPECT_EQ(queue.dropped(), Dropped{});
    for (uint32_t node = 0; node < 0x10000; ++node) {
        queue.push(command(Type::Stop, static_cast<uint16_t>(node), 1));
    }
    EXPECT_LE(queue.bytes(), kUrgentBytesMax);
    EXPECT_GT(queue.dropped().messages, 0u);
}

TEST(OutputQueue, WithoutEventsToDropTheNewcomerGoes) {
    OutputQueue queue;
    fill(queue, kReply);
    queue.push(frame(kReply, 0xabc));
    queue.push(frame(kEventType, 0xabd));
    EXPECT_EQ(queue.dropped(), (Dropped{1, 1}));
    EXPECT_EQ(sources(queue).size(), kQueueFramesMax);
}

TEST(OutputQueue, AReplyTakesThePlaceOfTheLastEventButAnEventDoesNot) {
    OutputQueue queue;
    queue.push(frame(kEventType, 1));
    for (size_t i = 1; i < kQueueFramesMax; ++i) queue.push(frame(kReply, 2));
    queue.push(frame(kEventType, 3));
    EXPECT_EQ(queue.dropped(), (Dropped{1, 0}));
    queue.push(frame(kReply, 4));
    EXPECT_EQ(queue.dropped(), (Dropped{2, 0}));
    EXPECT_EQ(queue.frames(), kQueueFramesMax);
    queue.push(frame(kReply, 5));
    EXPECT_EQ(queue.dropped(), (Dropped{2, 1}));
}

// A batch of 8-byte frames ends with the 512th: 4096 bytes. It stays as it is.
TEST(OutputQueue, TheBatchThatIsOnItsWayIsNeverDroppedNorPassed) {
    OutputQueue queue;
    fill(queue, kEventType);
    const auto batch = queue.batch();
    ASSERT_EQ(batch.size(), kBatchBytes);
    const std::vector<uint8_t> begun(batch.begin(), batch.end());
    queue.sent(3);
    queue.push(frame(kEventType, 0xabc));
    queue.push(frame(kReply, 0xabd));
    ASSERT_EQ(queue.dropped(), (Dropped{kDropFramesAtOnce, 0}));
    const auto rest = queue.batch();
    EXPECT_EQ(std::vector<uint8_t>(rest.begin(), rest.end()),
              std::vector<uint8_t>(begun.begin() + 3, begun.end()));
    queue.sent(rest.size());
    // Then the reply, which passes all events, and the first event that was not dropped.
    const auto next = queue.batch();
    const std::vector<uint8_t> begin(next.begin(), next.begin() + 12);
    EXPECT_EQ(begin, (std::vector<uint8_t>{2, 0, 0xbd, 0x0a, 5, 0x90, 0, 0,  //
                                           2, 0, 0, 0x0a}));                 // 512 + 2048 = 0xa00
}

TEST(OutputQueue, ManyRoundsOfFillingAndPartialSendingLoseNothing) {
    OutputQueue queue;
    std::vector<uint8_t> in, out;
    for (uint16_t round = 0; round < 5000; ++round) {
        const auto bytes = frame(kEventType, round, static_cast<uint16_t>(round % 517));
        in.insert(in.end(), bytes.begin(), bytes.end());
        queue.push(bytes);
        const auto batch = queue.batch();
        const size_t part = std::min<size_t>(batch.size(), 1 + (round * 7919u) % 600);
        out.insert(out.end(), batch.begin(), batch.begin() + static_cast<long>(part));
        queue.sent(part);
    }
    const auto rest = all_of(queue);
    out.insert(out.end(), rest.begin(), rest.end());
    EXPECT_EQ(queue.dropped(), (Dropped{0, 0}));
    EXPECT_TRUE(in == out);
}

TEST(OutputQueue, SixtyFourEventsKeepTheirPlaceBeforeAMessage) {
    OutputQueue queue;
    for (uint16_t i = 0; i < kEventsAhead; ++i) queue.push(frame(kEventType, i));
    queue.push(frame(kReply, 1000));
    const std::vector<uint16_t> order = sources(queue);
    EXPECT_EQ(order.front(), 0);
    EXPECT_EQ(order.back(), 1000);
}

TEST(OutputQueue, MessagesPassAFloodButNoOtherMessage) {
    OutputQueue queue;
    for (uint16_t i = 0; i < 5000; ++i) queue.push(frame(kEventType, i));
    for (uint16_t i = 0; i < 3; ++i) {
        queue.push(frame(kReply, static_cast<uint16_t>(6000 + i)));
        queue.push(frame(kEventType, static_cast<uint16_t>(5000 + i)));
    }
    std::vector<uint16_t> expected = {6000, 6001, 6002};
    for (uint16_t i = 0; i < 5003; ++i) expected.push_back(i);
    EXPECT_EQ(sources(queue), expected);
}

// The one that the kernel has not taken yet is the most that a command waits for.
TEST(OutputQueue, AMessageLeavesWithTheNextBatch) {
    OutputQueue queue;
    fill(queue, kEventType);
    queue.sent(queue.batch().size());
    queue.push(frame(kReply, 7));
    const auto next = queue.batch();
    EXPECT_EQ(next[2], 7);
    EXPECT_EQ(next[5], 0x90);
}

// A script whose handlers never end tells of one kill with each event.
TEST(OutputQueue, NoticesOfKilledEventsAreDroppedAndPassedLikeEvents) {
    OutputQueue queue;
    fill(queue, 0x9008);
    queue.push(frame(kReply, 7));
    EXPECT_EQ(queue.dropped(), (Dropped{kDropFramesAtOnce, 0}));
    wire::Frame first;
    ASSERT_TRUE(queue.pop(first));
    EXPECT_EQ(first.type, kReply);
}

TEST(OutputQueue, FewFramesLeaveInTheirOrderHoweverTheyAreMixed) {
    OutputQueue queue;
    std::vector<uint16_t> expected;
    for (uint16_t i = 0; i < 100; ++i) {
        queue.push(frame(i % 3 == 0 ? kReply : kEventType, i));
        if (i % 2 == 1) continue;
        wire::Frame out;
        ASSERT_TRUE(queue.pop(out));
        expected.push_back(out.source);
    }
    for (const uint16_t rest : sources(queue)) expected.push_back(rest);
    std::vector<uint16_t> sorted(100);
    for (uint16_t i = 0; i < 100; ++i) sorted[i] = i;
    EXPECT_EQ(expected, sorted);
}

}  // namespace
}  // namespace vagus::hub
