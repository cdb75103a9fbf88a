// Frames are dumps of docs/spec/aseba-wire-and-vm.md, sections 1.1 and 2.10, or made by hand from
// 2.2. Time is scripted.
#include "wire/line_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vagus::wire {
namespace {

using Bytes = std::vector<uint8_t>;

const Bytes kPresent1{2, 0, 1, 0, 0x0c, 0x90, 5, 0};                   // NodePresent of node 1
const Bytes kState1{4, 0, 1, 0, 0x0a, 0x90, 5, 0, 3, 0};               // ExecutionStateChanged
const Bytes kEvent1{4, 0, 1, 0, 4, 0, 5, 0, 0xf8, 0xff};               // event 4: 5 -8
const Bytes kVariables1{8, 0, 1, 0, 5, 0x90, 0, 0, 1, 0, 2, 0, 3, 0};  // Variables from 0: 1 2 3
const Bytes kUnknown1{2, 0, 1, 0, 0x0f, 0x90, 7, 0};                   // a type that is not ours

// A line on which a frame is written every 20 ms, and looked at between.
class Line {
public:
    explicit Line(uint32_t within_ms = kFrameWithin_ms) : reader(within_ms) {}

    void put(std::span<const uint8_t> bytes) {
        while (!bytes.empty()) {
            const uint16_t used =
                reader.feed(bytes.data(), static_cast<uint16_t>(bytes.size()), now_ms);
            bytes = bytes.subspan(used);
            take();
        }
        pass(20);
    }
    void pass(uint32_t span_ms) {
        for (uint32_t i = 0; i < span_ms; i += 10) {
            now_ms += 10;
            reader.tick(now_ms);
            take();
        }
    }
    std::vector<Bytes> taken() { return std::exchange(got_, {}); }

    LineReader reader;
    uint32_t now_ms = 0xffffff00;  // so that it wraps soon

private:
    void take() {
        Frame frame;
        while (reader.next(frame)) {
            Bytes bytes(kFrameMax);
            bytes.resize(encode(frame, bytes.data()));
            got_.push_back(std::move(bytes));
        }
    }
    std::vector<Bytes> got_;
};

Bytes operator+(Bytes a, const Bytes& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(LineReader, GivesFramesWithTheirLastByte) {
    Line line;
    const std::vector<Bytes> frames = {kPresent1, kEvent1, kVariables1, kState1};
    for (const Bytes& frame : frames) {
        for (size_t i = 0; i + 1 < frame.size(); i++) {
            ASSERT_EQ(line.reader.feed(&frame[i], 1, 0), 1);
            Frame none;
            ASSERT_FALSE(line.reader.next(none));
        }
        ASSERT_EQ(line.reader.feed(&frame.back(), 1, 0), 1);
        Frame one;
        ASSERT_TRUE(line.reader.next(one));
        EXPECT_EQ(one.source, 1);
    }
    EXPECT_EQ(line.reader.skipped(), 0u);
    EXPECT_FALSE(line.reader.waits());
}

TEST(LineReader, TheLongestFrameFitsAndOneByteMoreIsNone) {
    Line line;
    Bytes longest{0x04, 0x02, 1, 0, 5, 0x90};  // Variables with 516 bytes
    longest.resize(kFrameMax, 0x11);
    line.put(kPresent1);
    line.put(longest + kPresent1);
    EXPECT_EQ(line.taken(), (std::vector<Bytes>{kPresent1, longest, kPresent1}));
    Bytes longer = longest;
    longer[0] = 0x05;
    longer.push_back(0x11);
    line.put(longer);
    line.pass(kLineQuiet_ms);
    EXPECT_EQ(line.taken(), std::vector<Bytes>{});
    EXPECT_EQ(line.reader.skipped(), 523u);
    line.put(kPresent1);
    EXPECT_EQ(line.taken(), std::vector<Bytes>{kPresent1});
}

TEST(LineReader, AnEventOfAnUnheardSourceWaitsForAWitness) {
    Line line;
    line.put(kEvent1);
    EXPECT_EQ(line.taken(), std::vector<Bytes>{});
    line.put(kEvent1);
    EXPECT_EQ(line.taken(), (std::vector<Bytes>{kEvent1}));
    line.put(kPresent1);
    line.put(kEvent1);  // heard by now
    EXPECT_EQ(line.taken(), (std::vector<Bytes>{kEvent1, kPresent1, kEvent1}));

    Line alone;
    alone.put(kEvent1);
    alone.pass(kLineQuiet_ms);
    EXPECT_EQ(alone.taken(), std::vector<Bytes>{kEvent1});
    EXPECT_EQ(alone.reader.skipped(), 0u);
}

TEST(LineReader, UnknownTypesPassWithAWitness) {
    Line line;
    line.put(kPresent1);
    line.put(kUnknown1 + kState1);
    EXPECT_EQ(line.taken(), (std::vector<Bytes>{kPresent1, kUnknown1, kState1}));
}

TEST(LineReader, GarbageBeforeTheFirstFrameIsSkipped) {
    Line line;
    line.put(Bytes{0xff, 0xfe, 0x31, 0x32, 0x33} + kPresent1);
    line.put(kState1);
    EXPECT_EQ(line.taken(), (std::vector<Bytes>{kPresent1, kState1}));
    EXPECT_EQ(line.reader.skipped(), 5u);
}

TEST(LineReader, GarbageBeforeASilenceCostsNothingBehindIt) {
    Line line;
    line.put(Bytes{2, 0, 1});
    line.pass(kLineQuiet_ms);
    EXPECT_EQ(line.reader.skipped(), 3u);
    line.put(kPresent1);
    EXPECT_EQ(line.taken(), std::vector<Bytes>{kPresent1});
}

// Zeros look like event 0 of a host. A line that breaks sends many.
TEST(LineReader, ZerosAreNoEventsWhereNoHostWasHeard) {
    Line line;
    line.put(Bytes(100, 0) + kPresent1);
    line.put(kState1);
    EXPECT_EQ(line.taken(), (std::vector<Bytes>{kPresent1, kState1}));
    EXPECT_EQ(line.reader.skipped(), 100u);
}

TEST(LineReader, EventZeroOfAHostThatWasHeardComesAtOnce) {
    Line line;
    const Bytes list{2, 0, 0, 0, 0x11, 0xa0, 5, 0}, event0(6, 0);
    line.put(list);
    line.put(event0);
    EXPECT_EQ(line.taken(), (std::vector<Bytes>{list, event0}));
}

// ---- one byte lost or doubled, at every place of every kind of frame ----

// Before and behind the damaged frame pass whole ones; within a second all must come again.
void expect_healing(const Bytes& damaged, const Bytes& whole, const std::string& what) {
    Line line;
    const std::vector<Bytes> good = {kPresent1, kEvent1, kVariables1, kState1};
    for (const Bytes& frame : good) line.put(frame);
    ASSERT_EQ(line.taken(), good) << what;
    line.put(damaged);
    for (int i = 0; i < 50; i++) line.put(good[static_cast<size_t>(i) % 4]);  // a second
    std::vector<Bytes> meanwhile = line.taken();
    size_t foreign = 0;
    for (const Bytes& frame : meanwhile) {
        const bool is_good =
            frame == whole || std::find(good.begin(), good.end(), frame) != good.end();
        foreign += is_good ? 0 : 1;
    }
    EXPECT_LE(foreign, 1u) << what << ": only the damaged frame itself may come out wrong";
    EXPECT_GE(meanwhile.size(), 25u) << what;
    for (const Bytes& frame : good) line.put(frame);
    EXPECT_EQ(line.taken(), good) << what;
    EXPECT_FALSE(line.reader.lost()) << what;
}

TEST(LineReader, HealsAfterALostByteAtEveryPlace) {
    for (const Bytes& whole : {kPresent1, kState1, kEvent1, kVariables1}) {
        for (size_t at = 0; at < whole.size(); at++) {
            Bytes damaged = whole;
            damaged.erase(damaged.begin() + static_cast<long>(at));
            expect_healing(
                damaged, whole,
                "byte " + std::to_string(at) + " of " + std::to_string(whole.size()) + " lost");
        }
    }
}

TEST(LineReader, HealsAfterADoubledByteAtEveryPlace) {
    for (const Bytes& whole : {kPresent1, kState1, kEvent1, kVariables1}) {
        for (size_t at = 0; at < whole.size(); at++) {
            Bytes damaged = whole;
            damaged.insert(damaged.begin() + static_cast<long>(at), whole[at]);
            expect_healing(
                damaged, whole,
                "byte " + std::to_string(at) + " of " + std::to_string(whole.size()) + " doubled");
        }
    }
}

// A header that became 516 bytes long while small frames go on: it would take them all in.
TEST(LineReader, AFrameThatTakesTooLongIsGivenUp) {
    Line line(200);
    line.put(kPresent1);
    line.put(Bytes{4, 2, 1, 0, 5, 0x90});  // Variables with 516 bytes, which never come
    for (int i = 0; i < 15; i++) line.put(kState1);
    EXPECT_EQ(line.taken().size(), 16u);  // NodePresent and all states: they lay behind it
    EXPECT_EQ(line.reader.skipped(), 6u);
}

TEST(LineReader, SilenceCountsOnlyWhenItIsTold) {
    Line line;
    line.put(kPresent1);
    line.taken();
    const Bytes first(kState1.begin(), kState1.begin() + 7),
        rest(kState1.begin() + 7, kState1.end());
    EXPECT_EQ(line.reader.feed(first.data(), 7, line.now_ms), 7);
    line.now_ms += 60000;  // this process slept, and its bytes waited meanwhile
    EXPECT_EQ(line.reader.feed(rest.data(), 3, line.now_ms), 3);
    Frame frame;
    EXPECT_TRUE(line.reader.next(frame));
    EXPECT_EQ(line.reader.skipped(), 0u);
}

// Random frames, random damage, random pieces: after each a second of whole frames, the last of
// which must all come.
TEST(LineReader, HealsAfterRandomDamage) {
    const uint32_t seed = std::random_device{}();
    std::cout << "seed " << seed << "\n";
    std::mt19937 random(seed);
    const auto below = [&random](uint32_t limit) { return random() % limit; };
    Line line;
    for (int round = 0; round < 1000; round++) {
        Bytes noise(below(200));
        for (uint8_t& byte : noise) byte = static_cast<uint8_t>(below(3) == 0 ? 0 : random());
        line.put(noise);
        for (int i = 0; i < 50; i++) line.put(i % 2 == 0 ? kState1 : kVariables1);
        line.taken();
        std::vector<Bytes> expected;
        for (int i = 0; i < 10; i++) {
            Bytes frame{0, 0, static_cast<uint8_t>(1 + below(20)), 0, 5, 0x90};
            const auto words = static_cast<uint8_t>(1 + below(60));
            frame[0] = static_cast<uint8_t>(2 * words);
            for (int j = 0; j < 2 * words; j++) frame.push_back(static_cast<uint8_t>(random()));
            line.put(frame);
            expected.push_back(std::move(frame));
        }
        ASSERT_EQ(line.taken(), expected) << "seed " << seed << ", round " << round;
    }
}

}  // namespace
}  // namespace vagus::wire
