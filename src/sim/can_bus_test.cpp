#include "sim/can_bus.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <map>

#include "base/rng.hpp"
#include "wire/protocol.hpp"

using namespace vagus;
using namespace vagus::sim;
using namespace std::chrono_literals;

namespace {

wire::CanFrame eight(uint16_t identifier, uint8_t each) {
    wire::CanFrame frame{identifier, 8, {}};
    for (uint8_t& byte : frame.bytes) byte = each;
    return frame;
}

// `size` bytes of zeros. With type 0 and 6 bytes it is one CAN frame of eight zero bytes.
wire::Frame zeros(uint16_t source, uint16_t size) {
    wire::Frame frame{};
    frame.source = source;
    frame.size = size;
    return frame;
}

// From source 1: identifier 0x301, that of the first test, so 123 bits and 3 of intermission.
constexpr Duration kZerosTake = 123us;

// ---- bits ----

// Identifier 011 0000 0001, eight zero bytes. In brackets what stuffing adds:
//     start, identifier, remote, extended, reserved   0 01100000[1]001 0 0 0
//     size, and the data                              1 000 + 64 zeros: 67 zeros, 13 times 00000[1]
//     CRC, after two zeros left over                  11111[0]1001010101
// The CRC is the remainder of 0 01100000001 000 1000 and 64 zeros, times x^15, by 0x4599: 0x7e55.
// 1 + 11 + 3 + 4 + 64 + 15 = 98 bits, 1 + 13 + 1 = 15 stuffed, 1 + 2 + 7 behind them: 123.
TEST(CanBits, AreThoseOfTheStuffedFrame) {
    EXPECT_EQ(can_bits(eight(0x301, 0)), 123u);
}

// 0101… has no run to stuff: only the zeros of the identifier (0 011 0000 0[1]01) and the CRC
// 0x1f64 = 0011111[0]01100100 have one each.
TEST(CanBits, OfAlternatingBytesAreHardlyMore) {
    EXPECT_EQ(can_bits(eight(0x301, 0x55)), 44u + 64 + 2);
}

// 0 011 and then 15 zeros (8 of the identifier, 3, 4 of the size) with three bits stuffed, and the
// CRC 0x481e = 100100000[1]011110 with one.
TEST(CanBits, OfAnEmptyFrameAreThoseOfItsHeader) {
    EXPECT_EQ(can_bits({0x300, 0, {}}), 44u + 4);
}

// ---- one sender ----

TEST(CanBus, AFrameArrivesWhenItsLastBitIsOver) {
    CanBus bus;
    const CanPort one = bus.join("one");
    ASSERT_EQ(bus.send(one, zeros(1, 6), 1000us), CanSent::Queued);
    bus.advance(1000us + kZerosTake - 1us);
    EXPECT_FALSE(bus.take());
    bus.advance(1000us + kZerosTake);
    const auto got = bus.take();
    ASSERT_TRUE(got);
    EXPECT_EQ(got->from, one);
    EXPECT_EQ(got->queued, 1000us);
    EXPECT_EQ(got->received, 1123us);
    EXPECT_EQ(got->frame.source, 1);
    EXPECT_EQ(got->frame.size, 6);
    EXPECT_FALSE(bus.take());
}

TEST(CanBus, TheNextFrameWaitsForTheIntermission) {
    CanBus bus;
    const CanPort one = bus.join("one");
    ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    bus.advance(1ms);
    EXPECT_EQ(bus.take()->received, 123us);
    EXPECT_EQ(bus.take()->received, 123us + 3us + 123us);
}

// 30 bytes of payload and the type are 32: Start, two Normal, Stop.
TEST(CanBus, ALongFrameIsSeveralCanFramesAndArrivesWhole) {
    CanBus bus;
    const CanPort one = bus.join("one");
    ASSERT_EQ(bus.send(one, zeros(1, 30), 0us), CanSent::Queued);
    const uint32_t bits = can_bits(eight(0x101, 0)) + 2 * can_bits(eight(0x001, 0)) +
                          can_bits(eight(0x201, 0)) + 3 * kCanIntermissionBits;
    bus.advance(Time(bits) - 1us);
    EXPECT_FALSE(bus.take());
    bus.advance(Time(bits));
    ASSERT_TRUE(bus.take());
    EXPECT_EQ(bus.load(one).frames, 1u);
    EXPECT_EQ(bus.load(one).can_frames, 4u);
    EXPECT_EQ(bus.load(one).bits, bits + kCanIntermissionBits);
}

// ---- arbitration ----

TEST(CanBus, TheLowestIdentifierGoesFirst) {
    CanBus bus;
    const CanPort three = bus.join("three");
    const CanPort two = bus.join("two");
    const CanPort one = bus.join("one");
    ASSERT_EQ(bus.send(three, zeros(3, 6), 0us), CanSent::Queued);
    ASSERT_EQ(bus.send(two, zeros(2, 6), 0us), CanSent::Queued);
    ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    bus.advance(1ms);
    EXPECT_EQ(bus.take()->from, one);
    EXPECT_EQ(bus.take()->from, two);
    EXPECT_EQ(bus.take()->from, three);
}

TEST(CanBus, AFrameUnderWayIsNotInterrupted) {
    CanBus bus;
    const CanPort nine = bus.join("nine");
    const CanPort one = bus.join("one");
    ASSERT_EQ(bus.send(nine, zeros(9, 6), 0us), CanSent::Queued);
    bus.advance(1us);
    ASSERT_EQ(bus.send(one, zeros(1, 6), 1us), CanSent::Queued);
    bus.advance(1ms);
    EXPECT_EQ(bus.take()->from, nine);
    EXPECT_EQ(bus.take()->from, one);
}

// What is sent at the instant up to which the bus has worked still takes part in the arbitration of
// that instant.
TEST(CanBus, SendersOfOneInstantMeetWhateverTheOrderOfTheCalls) {
    CanBus bus;
    const CanPort nine = bus.join("nine");
    const CanPort one = bus.join("one");
    ASSERT_EQ(bus.send(nine, zeros(9, 6), 5us), CanSent::Queued);
    bus.advance(5us);
    ASSERT_EQ(bus.send(one, zeros(1, 6), 5us), CanSent::Queued);
    bus.advance(1ms);
    EXPECT_EQ(bus.take()->from, one);
}

// Identifiers: Start 0x105, Stop 0x205 against Small 0x301: the parts of 5 come before, both.
TEST(CanBus, PartsOfALongFrameOutrankSmallOnes) {
    CanBus bus;
    const CanPort five = bus.join("five");
    const CanPort one = bus.join("one");
    ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    ASSERT_EQ(bus.send(five, zeros(5, 10), 0us), CanSent::Queued);
    bus.advance(1ms);
    EXPECT_EQ(bus.take()->from, five);
    EXPECT_EQ(bus.take()->from, one);
}

// ---- limits ----

TEST(CanBus, AFullQueueDropsWholeFramesAndCountsThem) {
    CanBus bus;
    const CanPort one = bus.join("one");
    for (size_t i = 0; i < kCanQueueMax; ++i)
        ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    EXPECT_EQ(bus.room(one), 0u);
    EXPECT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Dropped);
    EXPECT_EQ(bus.load(one).dropped, 1u);
    EXPECT_EQ(bus.load(one).waiting, kCanQueueMax);
    bus.advance(1us);  // one has left the queue: room for one, not for two
    EXPECT_EQ(bus.send(one, zeros(1, 10), 1us), CanSent::Dropped);
    EXPECT_EQ(bus.send(one, zeros(1, 6), 1us), CanSent::Queued);
    bus.advance(1s);
    EXPECT_EQ(bus.load(one).frames, kCanQueueMax + 1);
    EXPECT_EQ(bus.load(one).dropped, 2u);
    EXPECT_EQ(bus.load(one).waiting_most, kCanQueueMax);
}

TEST(CanBus, ASourceBeyondEightBitsFitsNoIdentifier) {
    CanBus bus;
    const CanPort main = bus.join("main");
    EXPECT_EQ(bus.send(main, zeros(256, 6), 0us), CanSent::Unfit);
    EXPECT_EQ(bus.load(main).dropped, 1u);
}

// 100 frames a millisecond want 12.6 times the bus. It is full, the lower identifier has all of it,
// and nobody waits for more than what the queue holds.
TEST(CanBus, ASaturatedBusServesTheLowestIdentifierAndStarvesTheRest) {
    CanBus bus;
    const CanPort one = bus.join("one");
    const CanPort two = bus.join("two");
    for (Time t{}; t < 2s; t += 1ms) {
        for (int i = 0; i < 100; ++i) {
            (void)bus.send(one, zeros(1, 6), t);
            (void)bus.send(two, zeros(2, 6), t);
        }
        bus.advance(t + 1ms);
        EXPECT_LE(bus.load(two).waiting, kCanQueueMax);
    }
    EXPECT_GT(bus.load().share_of_last_second, 0.999);
    EXPECT_LE(bus.load().share_of_last_second, 1);
    EXPECT_GE(bus.load(one).frames, 2'000'000u / 126);
    EXPECT_EQ(bus.load(two).frames, 0u);
    EXPECT_GT(bus.load(two).dropped, 0u);
    // 256 in the queue and the one under way.
    EXPECT_LE(bus.load(one).latency_worst, (kCanQueueMax + 1) * 126us);
}

// Five ports send frames of random sizes at random times: nothing is lost, each port's frames come
// in their order, and no two are on the bus at once.
TEST(CanBus, RandomTrafficIsCarriedWholeAndOneAfterTheOther) {
    constexpr uint64_t kSeed = 20240611;
    SCOPED_TRACE(kSeed);
    SplitMix64 random(kSeed);
    CanBus bus;
    std::vector<CanPort> ports;
    for (int i = 0; i < 5; ++i) ports.push_back(bus.join(std::to_string(i)));
    std::map<uint32_t, std::deque<uint16_t>> on_their_way;  // by port: the types of its frames
    Time last{};
    for (Time t{}; t < 3s; t += 1ms) {
        for (uint64_t i = random.below(6); i > 0; --i) {
            const auto port = static_cast<uint32_t>(random.below(ports.size()));
            wire::Frame frame =
                zeros(static_cast<uint16_t>(port + 1), static_cast<uint16_t>(random.below(30)));
            frame.type = static_cast<uint16_t>(random.next());
            if (bus.send(ports[port], frame, t) == CanSent::Queued)
                on_their_way[port].push_back(frame.type);
        }
        bus.advance(t + 1ms);
        while (const auto got = bus.take()) {
            std::deque<uint16_t>& expected = on_their_way[got->from.index];
            ASSERT_FALSE(expected.empty());
            ASSERT_EQ(got->frame.type, expected.front());
            expected.pop_front();
            // The last part has one byte at least: 44 + 8 bits.
            ASSERT_GE(got->received, last + (44us + 8us) + kCanIntermissionBits * 1us);
            last = got->received;
        }
    }
    bus.advance(60s);
    uint64_t left = 0;
    while (bus.take()) ++left;
    uint64_t expected = 0;
    for (const auto& [port, types] : on_their_way) expected += types.size();
    EXPECT_EQ(left, expected);
    EXPECT_EQ(bus.load().waiting, 0u);
}

// ---- counting ----

TEST(CanBus, LoadIsThatOfTheLastSecondAndOfAll) {
    CanBus bus;
    const CanPort one = bus.join("one");
    const CanPort two = bus.join("two");
    for (Time t{}; t < 1s; t += 10ms) {
        ASSERT_EQ(bus.send(one, zeros(1, 6), t), CanSent::Queued);
        bus.advance(t + 10ms);
    }
    // 100 frames of 123 + 3 bits in a second of 1,000,000.
    EXPECT_DOUBLE_EQ(bus.load(one).share_of_all, 0.0126);
    EXPECT_NEAR(bus.load(one).share_of_last_second, 0.0126, 0.0002);
    EXPECT_EQ(bus.load(two).share_of_all, 0);
    EXPECT_EQ(bus.load(one).name, "one");
    bus.advance(3s);
    EXPECT_EQ(bus.load(one).share_of_last_second, 0);
    EXPECT_DOUBLE_EQ(bus.load(one).share_of_all, 0.0042);
}

// Three at once: 123, 249 and 375 microseconds.
TEST(CanBus, LatencyIsFromQueuedToReceived) {
    CanBus bus;
    const CanPort one = bus.join("one");
    for (int i = 0; i < 3; ++i) ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    bus.advance(1ms);
    EXPECT_EQ(bus.load(one).latency_median, 249us);
    EXPECT_EQ(bus.load(one).latency_p99, 375us);
    EXPECT_EQ(bus.load(one).latency_worst, 375us);
}

// The latest count: after kLatenciesKept quick ones the slow one is the worst, but no median.
TEST(CanBus, OldLatenciesAreForgotten) {
    CanBus bus;
    const CanPort one = bus.join("one");
    ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    Time t = 1ms;
    bus.advance(t);
    for (size_t i = 0; i < kLatenciesKept; ++i, t += 1ms) {
        ASSERT_EQ(bus.send(one, zeros(1, 6), t), CanSent::Queued);
        bus.advance(t + 1ms);
    }
    EXPECT_EQ(bus.load(one).latency_p99, 123us);
    EXPECT_EQ(bus.load(one).latency_worst, 249us);
}

TEST(CanBus, AfterAResetNothingIsLeftButThePorts) {
    CanBus bus;
    const CanPort one = bus.join("one");
    for (int i = 0; i < 3; ++i) ASSERT_EQ(bus.send(one, zeros(1, 6), 0us), CanSent::Queued);
    bus.advance(200us);
    bus.reset();
    bus.advance(1s);
    EXPECT_FALSE(bus.take());
    EXPECT_EQ(bus.load(one).bits, 0u);
    EXPECT_EQ(bus.load(one).name, "one");
    EXPECT_EQ(bus.ports(), 1u);
}

}  // namespace
