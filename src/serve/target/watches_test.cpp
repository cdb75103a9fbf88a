// What pages look at, with as many words as somebody likes to name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "serve/target/test_target.hpp"
#include "serve/target/word_ranges.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

TEST(WordRanges, WhatOverlapsIsOne) {
    EXPECT_EQ(merged({{6, 8}, {1, 6}, {0, 2}, {3, 3}, {7, 8}}), (WordRanges{{0, 6}, {6, 8}}));
    const WordRanges ranges = merged({{2, 4}, {10, 11}});
    EXPECT_EQ(words_in(ranges), 3u);
    EXPECT_FALSE(has_some(ranges, 0, 2));
    EXPECT_TRUE(has_some(ranges, 0, 3));
    EXPECT_TRUE(has_some(ranges, 3, 10));
    EXPECT_FALSE(has_some(ranges, 4, 10));
    EXPECT_TRUE(has_some(ranges, 4, 11));
    EXPECT_FALSE(has_some(ranges, 11, 99));
}

class WatchedTest : public TargetTest {
protected:
    Json watch(uint32_t number, uint32_t node, const Json& ranges) {
        return say("watch", {{"watch", number},
                             {"topic", "variables"},
                             {"of", {{"node", node}, {"ranges", ranges}}}});
    }
};

// What was seen: 256 times the same 4096 words, put into a set word by word at every turn.
TEST_F(WatchedTest, NamingWordsTwiceCostsNothing) {
    connect();
    Json ranges = Json::array();
    for (int i = 0; i < 256; ++i) ranges.push_back({0, 4096});
    EXPECT_TRUE(watch(1, kDrive, ranges).contains("ok"));
    const uint64_t made = target.watched_made();
    for (int i = 0; i < 100; ++i) pass(10ms);
    EXPECT_EQ(target.watched_made(), made + 1);
    ask("unwatch", {{"watch", 1}});
    pass(10ms);
    EXPECT_EQ(target.watched_made(), made + 2);
}

// What is watched already is told again only when it changes; a plot of it was empty until then.
TEST_F(WatchedTest, APlotBeginsWithTheValueThatIsKnown) {
    constexpr uint16_t kWheelTarget = 34;  // behind id, source and 32 arguments
    constexpr char kSamples = 2;           // as the protocol numbers the topic
    connect();
    bus.word(kDrive, "wheel.target") = 7;
    EXPECT_TRUE(watch(1, kDrive, {{kWheelTarget, kWheelTarget + 1}}).contains("ok"));
    pass(1s);
    const Json words = {{kDrive, kWheelTarget}};
    ask("watch", {{"watch", 2}, {"topic", "samples"}, {"of", {{"words", words}}}});
    for (int i = 0; i < 10; ++i) {
        pass(100ms);
        desk.tick(now);
    }
    std::erase_if(frames_, [](const std::string& frame) { return frame[0] != kSamples; });
    ASSERT_EQ(frames_.size(), 1u);
    // A head of 16 bytes, then time, index and value of each sample.
    ASSERT_EQ(frames_[0].size(), 16u + 12u);
    EXPECT_EQ(frames_[0].substr(16 + 8), std::string("\0\0\7\0", 4));
}

TEST_F(WatchedTest, ASubscriptionHasALimitOfWords) {
    EXPECT_TRUE(watch(1, kDrive, {{0, 4000}, {4000, 96}}).contains("ok"));
    const Json answer = watch(2, kDrive, {{0, 4000}, {4000, 97}});
    EXPECT_EQ(answer["error"]["code"], "limit");
    EXPECT_THAT(answer["error"]["what"].get<std::string>(), HasSubstr("4097 words"));
}

}  // namespace
}  // namespace vagus::serve
