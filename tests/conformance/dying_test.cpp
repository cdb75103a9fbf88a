// Whatever becomes of the node meanwhile, the examination ends, and tells it.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/rng.hpp"
#include "virtual_line.hpp"
#include "wire/messages.hpp"
#include "wire/reports.hpp"

namespace vagus::conformance {
namespace {

using Frames = std::vector<wire::Frame>;

// What one examination may take if every answer must be waited for.
constexpr Duration kLongest = std::chrono::hours(1);

Report examine_within(VirtualLine& line, Duration longest) {
    const Report report = examine(line, {.node = 1, .nobody = 2, .only = ""}, node_with());
    EXPECT_LT(line.now(), longest);
    return report;
}

TEST(ConformanceEnds, WhoIsThereIsWaitedForAndNoLonger) {
    VirtualLine line(node_with());
    EXPECT_EQ(who_is_there(line).value(), std::vector<uint16_t>{1});
    VirtualLine empty(node_with(), {.to_node = [](const wire::Frame&) { return Frames{}; }});
    const Time before = empty.now();
    EXPECT_EQ(who_is_there(empty).value(), std::vector<uint16_t>{});
    EXPECT_EQ(empty.now() - before, kPresenceMost + std::chrono::microseconds(100));
    EXPECT_FALSE(describe(empty, 1).ok());
}

// At any frame the node falls silent for ever.
TEST(ConformanceEnds, ANodeThatDiesIsAFindingAndNoHang) {
    for (const int frames : {0, 1, 100, 500, 1000}) {
        int heard = 0;
        VirtualLine line(node_with(), {.to_node = [&heard, frames](const wire::Frame& frame) {
                             return heard++ < frames ? Frames{frame} : Frames{};
                         }});
        const Report report = examine_within(line, std::chrono::minutes(1));
        EXPECT_GT(report.count(Verdict::NotRun), 0u) << frames;
        EXPECT_FALSE(report.left_clear);
        const std::string rest = rows_with(report, Verdict::NotRun);
        EXPECT_NE(rest.find("lost at \""), std::string::npos) << rest;
    }
}

// The connection breaks: nothing is waited for.
TEST(ConformanceEnds, ALineThatBreaksIsToldAtOnce) {
    VirtualLine line(node_with());
    line.break_after(300);
    const Report report = examine_within(line, std::chrono::seconds(1));
    EXPECT_GT(report.count(Verdict::NotRun), 0u);
    EXPECT_NE(rows_with(report, Verdict::NotRun).find("the cable was pulled"), std::string::npos);
}

TEST(ConformanceEnds, ANodeThatFloodsTheBusIsAFinding) {
    VirtualLine line(node_with(), {.from_node = [](const wire::Frame& frame) {
                         return Frames(kHeardMax + 1, frame);
                     }});
    const Report report = examine_within(line, kLongest);
    EXPECT_GT(report.count(Verdict::Failed) + report.count(Verdict::NotRun), 100u);
}

// A line that loses, doubles and changes frames at random.
TEST(ConformanceEnds, NoiseEndsNothing) {
    for (uint32_t seed = 1; seed <= 30; seed++) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        SplitMix64 random(seed);
        const Change noise = [&random](wire::Frame frame) {
            switch (random.below(60)) {
                case 0:
                    return Frames{};
                case 1:
                    return Frames{frame, frame};
                case 2:
                    if (frame.size > 0) frame.payload[random.below(frame.size)]++;
                    return Frames{frame};
                default:
                    return Frames{frame};
            }
        };
        VirtualLine line(node_with(), {.to_node = noise, .from_node = noise});
        (void)examine_within(line, kLongest);
    }
}

// Each check waits in vain, so each needs 5 s; the third cannot end.
TEST(ConformanceEnds, WhatIsLeftWhenTheTimeIsOverIsNotRun) {
    const auto deaf = [](const wire::Frame& frame) {
        const bool state =
            frame.type == static_cast<uint16_t>(wire::MessageType::ExecutionStateChanged);
        return state ? Frames{} : Frames{frame};
    };
    VirtualLine line(node_with(), {.from_node = deaf});
    const Report report = examine(
        line, {.node = 1, .nobody = 2, .time_limit = std::chrono::seconds(12), .only = "operators"},
        node_with());
    EXPECT_LT(line.now(), std::chrono::seconds(13));
    EXPECT_EQ(report.count(Verdict::Failed), 2u) << rows_with(report, Verdict::Failed);
    EXPECT_EQ(report.count(Verdict::NotRun), report.rows.size() - 2);
    const std::string rest = rows_with(report, Verdict::NotRun);
    EXPECT_NE(rest.find("the time limit of 12 s is over: give more, by --max-time"),
              std::string::npos)
        << rest;
    EXPECT_TRUE(report.left_clear);
}

// What a check leaves in memory is gone before the next one, to the last word that was used.
TEST(ConformanceEnds, MemoryIsClearedBeforeEachCheck) {
    std::vector<int16_t> memory(1060, 1);
    size_t checks = 0;
    const uint16_t first = 38;  // behind what node_with() describes
    VirtualLine line(node_with(), {.to_node = [&](const wire::Frame& frame) {
                         wire::SetVariables set;
                         const bool sets = wire::decode_message(frame, set) == wire::Error::None;
                         for (uint16_t i = 0; sets && i < set.values.count; i++) {
                             if (set.start + i < 1060) memory[set.start + i] = set.values.values[i];
                         }
                         wire::BreakpointClearAll cleared;
                         if (wire::decode_message(frame, cleared) == wire::Error::None) {
                             checks++;
                             const auto dirty =
                                 std::find_if(memory.begin() + first, memory.end(),
                                              [](int16_t word) { return word != 0; });
                             EXPECT_TRUE(dirty == memory.end())
                                 << "word " << dirty - memory.begin() << " at check " << checks;
                         }
                         return Frames{frame};
                     }});
    const Report report = examine(line, {.node = 1, .nobody = 2, .only = "natives"}, node_with());
    EXPECT_EQ(rows_with(report, Verdict::Failed), "");
    EXPECT_GT(checks, 30u);
}

// Frames of another host are counted, and those of other nodes are not taken for ours.
TEST(ConformanceEnds, OthersOnTheBusAreNotHeard) {
    VirtualLine line(node_with(), {.from_node = [](const wire::Frame& frame) {
                         wire::Frame other = frame;
                         other.source = 9;
                         wire::Frame host{};
                         host.type = static_cast<uint16_t>(wire::MessageType::GetExecutionState);
                         wire::add_argument(host, 1);
                         return Frames{other, host, frame};
                     }});
    const Report report = examine_within(line, kLongest);
    EXPECT_EQ(rows_with(report, Verdict::Failed), "");
    EXPECT_GT(report.foreign, 100u);
}

}  // namespace
}  // namespace vagus::conformance
