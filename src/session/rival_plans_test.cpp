#include "session/rival_plans.hpp"

#include <gtest/gtest.h>

namespace vagus::session {
namespace {

using run::BusEvent;

RivalPlans rivals(uint64_t seed = 1) {
    return RivalPlans({"go", "watch"}, SplitMix64(seed));
}

// 15 bits, never 0, and not the same for every run.
TEST(RivalPlans, TheFirstTokenIsAnyThatFits) {
    std::set<uint16_t> seen;
    for (uint64_t seed = 0; seed < 1000; ++seed) {
        const uint16_t token = rivals(seed).random_token();
        EXPECT_GE(token, 1);
        EXPECT_LE(token, 0x7fff);
        seen.insert(token);
    }
    EXPECT_GT(seen.size(), 900u);
}

TEST(RivalPlans, AStartThatThisPlanHasNotSentIsTheNewsOnce) {
    RivalPlans all = rivals();
    all.said({"go", {100, 5}});
    const auto first = all.hear({"go", {101, 5}});
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->is_news);
    ASSERT_TRUE(first->move_to);
    // At least 0x1000 away, either way around.
    EXPECT_GE((*first->move_to - 101) & 0x7fff, 0x1000);
    EXPECT_GE((101 - *first->move_to) & 0x7fff, 0x1000);

    const auto second = all.hear({"watch", {102}});
    ASSERT_TRUE(second);
    EXPECT_FALSE(second->is_news);
    EXPECT_FALSE(second->move_to);  // far away by now
}

TEST(RivalPlans, OneThatComesNearAgainIsGivenWayToAgain) {
    RivalPlans all = rivals();
    ASSERT_TRUE(all.hear({"go", {1}}));
    all.said({"go", {0x7ff0}});
    const auto across_the_end = all.hear({"go", {0x10}});  // 31 steps on: 0x7fff, then 1
    ASSERT_TRUE(across_the_end);
    EXPECT_TRUE(across_the_end->move_to);
    all.said({"go", {0x3000}});
    EXPECT_FALSE(all.hear({"go", {0x4000}})->move_to);  // 0x1000 away
    EXPECT_TRUE(all.hear({"go", {0x3fff}})->move_to);   // one less
}

TEST(RivalPlans, OtherEventsAndWhatABusGivesBackAreNone) {
    RivalPlans all = rivals();
    all.said({"go", {7, 5}});
    EXPECT_FALSE(all.hear({"go", {7, 5}}));
    EXPECT_FALSE(all.hear({"button", {7}}));
    EXPECT_FALSE(all.hear({"go", {}}));
    EXPECT_TRUE(all.hear({"go", {7, 5}}));  // ours has come back already
}

}  // namespace
}  // namespace vagus::session
