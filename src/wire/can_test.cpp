// Expected frames are measured ones of docs/spec/aseba-wire-and-vm.md, section 1.6, or cut by hand.
#include "wire/can.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace vagus::wire {

// GoogleTest finds these beside the type.
static bool operator==(const CanFrame& a, const CanFrame& b) {
    return a.identifier == b.identifier && std::vector<int>(a.bytes, a.bytes + a.size) ==
                                               std::vector<int>(b.bytes, b.bytes + b.size);
}
static void PrintTo(const CanFrame& frame, std::ostream* out) {
    *out << std::hex << frame.identifier << " [" << int{frame.size} << "]";
    for (uint8_t i = 0; i < frame.size && i < 8; ++i) *out << " " << int{frame.bytes[i]};
}

namespace {

CanFrame can(uint16_t identifier, const std::vector<uint8_t>& bytes) {
    CanFrame frame{};
    frame.identifier = identifier;
    frame.size = static_cast<uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), frame.bytes);
    return frame;
}

Frame packet(uint16_t source, uint16_t type, std::vector<uint8_t> payload) {
    Frame frame{};
    frame.source = source;
    frame.type = type;
    frame.size = static_cast<uint16_t>(payload.size());
    std::copy(payload.begin(), payload.end(), frame.payload);
    return frame;
}

std::vector<CanFrame> fragments(const Frame& frame) {
    std::vector<CanFrame> parts(kCanFramesMax);
    parts.resize(can_fragment(frame, parts.data()));
    return parts;
}

std::vector<uint8_t> payload_of(const Frame& frame) {
    return {frame.payload, frame.payload + frame.size};
}

std::vector<uint8_t> counting(size_t size) {
    std::vector<uint8_t> bytes(size);
    for (size_t i = 0; i < size; ++i) bytes[i] = static_cast<uint8_t>(i);
    return bytes;
}

// ListNodes, Run …: a packet that fits one frame, told apart by its source.
CanFrame small(uint8_t source) {
    return can(static_cast<uint16_t>(0x300 | source), {1, 0});
}

const Frame kDescription =
    packet(1, 0x9000, {0x0b, 'd', 'u', 'm',  'm', 'y',  'n', 'o', 'd', 'e', '-', '0',  5,
                       0,    0,   2,   0x40, 0,   0x24, 4,   5,   0,   1,   0,   0x1e, 0});
const std::vector<CanFrame> kDescriptionOnCan{
    can(0x101, {0x00, 0x90, 0x0b, 0x64, 0x75, 0x6d, 0x6d, 0x79}),
    can(0x001, {0x6e, 0x6f, 0x64, 0x65, 0x2d, 0x30, 0x05, 0x00}),
    can(0x001, {0x00, 0x02, 0x40, 0x00, 0x24, 0x04, 0x05, 0x00}),
    can(0x201, {0x01, 0x00, 0x1e, 0x00})};

TEST(Can, CutsTheMeasuredDescriptionAndTheMeasuredRun) {
    EXPECT_EQ(fragments(kDescription), kDescriptionOnCan);
    EXPECT_EQ(fragments(packet(0, 0xa003, {1, 0})),
              (std::vector<CanFrame>{can(0x300, {0x03, 0xa0, 0x01, 0x00})}));
}

TEST(Can, SixteenInnerBytesNeedNoMiddle) {
    const auto parts = fragments(packet(2, 0x0004, counting(14)));
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0], can(0x102, {4, 0, 0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(parts[1], can(0x202, {6, 7, 8, 9, 10, 11, 12, 13}));
}

TEST(Can, EightInnerBytesAreSmallAndNineAreNot) {
    EXPECT_EQ(fragments(packet(2, 4, counting(6))),
              (std::vector<CanFrame>{can(0x302, {4, 0, 0, 1, 2, 3, 4, 5})}));
    EXPECT_EQ(fragments(packet(2, 4, counting(7))),
              (std::vector<CanFrame>{can(0x102, {4, 0, 0, 1, 2, 3, 4, 5}), can(0x202, {6})}));
    EXPECT_EQ(fragments(packet(2, 4, {})), (std::vector<CanFrame>{can(0x302, {4, 0})}));
}

TEST(Can, RefusesASourceThatDoesNotFitTheIdentifier) {
    EXPECT_EQ(fragments(packet(255, 4, {})).size(), 1u);
    EXPECT_EQ(fragments(packet(256, 4, {})).size(), 0u);
    EXPECT_EQ(fragments(packet(0x105, 4, {})).size(), 0u);  // would be 0x305 on the bus
}

TEST(Can, TheLargestPacketTakesAllFramesAndComesBack) {
    const Frame largest = packet(9, 0x0123, counting(kPayloadMax));
    const auto parts = fragments(largest);
    EXPECT_EQ(parts.size(), kCanFramesMax);
    CanReassembler<kCanFramesMax + 1> incoming;
    for (const CanFrame& part : parts) EXPECT_EQ(incoming.put(part), CanPut::Stored);
    Frame back;
    ASSERT_TRUE(incoming.take(back));
    EXPECT_EQ(back.source, 9);
    EXPECT_EQ(back.type, 0x0123);
    EXPECT_EQ(payload_of(back), counting(kPayloadMax));
    EXPECT_FALSE(incoming.take(back));
    EXPECT_EQ(incoming.waiting(), 0);
}

TEST(Can, EveryPayloadSizeComesBack) {
    CanReassembler<kCanFramesMax + 1> incoming;
    for (uint16_t size = 0; size <= kPayloadMax; ++size) {
        for (const CanFrame& part : fragments(packet(3, 7, counting(size)))) {
            ASSERT_EQ(incoming.put(part), CanPut::Stored);
        }
        Frame back;
        ASSERT_TRUE(incoming.take(back)) << size;
        ASSERT_EQ(payload_of(back), counting(size));
    }
}

TEST(Can, SourcesMayInterleave) {
    const auto a = fragments(packet(1, 4, counting(20)));  // 3 frames each
    const auto b = fragments(packet(2, 5, counting(22)));
    CanReassembler<10> incoming;
    for (const CanFrame& each : {a[0], b[0], a[1], small(3), b[1], b[2], a[2]}) {
        EXPECT_EQ(incoming.put(each), CanPut::Stored);
    }
    std::vector<uint16_t> sources;
    Frame out;
    while (incoming.take(out)) {
        sources.push_back(out.source);
        const size_t sizes[] = {0, 20, 22, 0};
        EXPECT_EQ(payload_of(out), counting(sizes[out.source]));
    }
    EXPECT_EQ(sources, (std::vector<uint16_t>{3, 2, 1}));  // in the order in which they were whole
    EXPECT_EQ(incoming.lost(), 0u);
}

TEST(Can, IgnoresWhatIsNoPartOfAPacket) {
    CanReassembler<4> incoming;
    EXPECT_EQ(incoming.put(can(0x401, {1, 0})), CanPut::Ignored);
    EXPECT_EQ(incoming.put(can(0x701, {1, 0})), CanPut::Ignored);
    EXPECT_EQ(incoming.put(can(0x801, {1, 0})), CanPut::Ignored);
    CanFrame long_frame = small(1);
    long_frame.size = 9;
    EXPECT_EQ(incoming.put(long_frame), CanPut::Ignored);
    EXPECT_EQ(incoming.waiting(), 0);
}

TEST(Can, KeepsOneFrameFreeAndDropsTheNext) {
    CanReassembler<4> incoming;
    for (uint8_t source = 1; source <= 3; ++source) {
        EXPECT_EQ(incoming.put(small(source)), CanPut::Stored);
    }
    EXPECT_EQ(incoming.put(small(4)), CanPut::Overflow);
    EXPECT_EQ(incoming.lost(), 1u);
    EXPECT_EQ(incoming.waiting(), 3);
}

TEST(Can, AStopThatFindsNoRoomFreesItsPacketOnly) {
    CanReassembler<4> incoming;
    EXPECT_EQ(incoming.put(kDescriptionOnCan[0]), CanPut::Stored);
    EXPECT_EQ(incoming.put(small(1)), CanPut::Stored);
    EXPECT_EQ(incoming.put(small(2)), CanPut::Stored);
    EXPECT_EQ(incoming.put(kDescriptionOnCan[3]), CanPut::Overflow);
    EXPECT_EQ(incoming.waiting(), 2);
    EXPECT_EQ(incoming.lost(), 2u);
}

TEST(Can, APacketThatLostItsMiddleIsNeverGiven) {
    CanReassembler<4> incoming;
    EXPECT_EQ(incoming.put(kDescriptionOnCan[0]), CanPut::Stored);
    EXPECT_EQ(incoming.put(small(2)), CanPut::Stored);
    EXPECT_EQ(incoming.put(small(3)), CanPut::Stored);
    EXPECT_EQ(incoming.put(kDescriptionOnCan[1]), CanPut::Overflow);
    Frame out;
    while (incoming.take(out)) EXPECT_NE(out.source, 1);
    EXPECT_EQ(incoming.put(kDescriptionOnCan[2]), CanPut::Orphan);
    EXPECT_EQ(incoming.put(kDescriptionOnCan[3]), CanPut::Orphan);
    EXPECT_FALSE(incoming.take(out));
    // The next packet of that source is whole again.
    for (size_t i : {0, 3}) EXPECT_EQ(incoming.put(kDescriptionOnCan[i]), CanPut::Stored);
    ASSERT_TRUE(incoming.take(out));
    EXPECT_EQ(out.source, 1);
    EXPECT_EQ(out.size, 10);
}

TEST(Can, AStopWithoutItsStartIsDiscarded) {
    CanReassembler<8> incoming;
    EXPECT_EQ(incoming.put(kDescriptionOnCan[1]), CanPut::Orphan);
    EXPECT_EQ(incoming.put(kDescriptionOnCan[3]), CanPut::Orphan);
    Frame out;
    EXPECT_FALSE(incoming.take(out));
    EXPECT_EQ(incoming.lost(), 2u);
}

TEST(Can, AStartEndsAPacketWhoseStopWasLost) {
    CanReassembler<8> incoming;
    EXPECT_EQ(incoming.put(can(0x101, {9, 9, 9, 9, 9, 9, 9, 9})), CanPut::Stored);
    for (const CanFrame& part : kDescriptionOnCan) EXPECT_EQ(incoming.put(part), CanPut::Stored);
    Frame out;
    ASSERT_TRUE(incoming.take(out));
    EXPECT_EQ(out.type, 0x9000);
    EXPECT_EQ(payload_of(out), payload_of(kDescription));
    EXPECT_EQ(incoming.lost(), 1u);
}

TEST(Can, APacketOfOneFrameTooManyIsLostAsAWhole) {
    CanReassembler<200> incoming;
    EXPECT_EQ(incoming.put(can(0x101, counting(8))), CanPut::Stored);
    for (int i = 0; i < kCanFramesMax - 2; ++i) {
        ASSERT_EQ(incoming.put(can(0x001, counting(8))), CanPut::Stored) << i;
    }
    EXPECT_EQ(incoming.put(can(0x001, counting(8))), CanPut::Orphan);
    EXPECT_EQ(incoming.waiting(), 0);
    EXPECT_EQ(incoming.put(can(0x201, {1})), CanPut::Orphan);
}

TEST(Can, PacketsWithOneByteTooManyOrWithoutATypeAreLost) {
    CanReassembler<200> incoming;
    EXPECT_EQ(incoming.put(can(0x101, counting(8))), CanPut::Stored);
    for (int i = 0; i < kCanFramesMax - 2; ++i) (void)incoming.put(can(0x001, counting(8)));
    EXPECT_EQ(incoming.put(can(0x201, counting(7))), CanPut::Stored);  // 64 * 8 + 7 = 519
    EXPECT_EQ(incoming.put(can(0x302, {1})), CanPut::Stored);
    EXPECT_EQ(incoming.put(small(3)), CanPut::Stored);
    Frame out;
    ASSERT_TRUE(incoming.take(out));
    EXPECT_EQ(out.source, 3);
    EXPECT_FALSE(incoming.take(out));
    EXPECT_EQ(incoming.lost(), kCanFramesMax + 1u);
    EXPECT_EQ(incoming.waiting(), 0);
}

}  // namespace
}  // namespace vagus::wire
