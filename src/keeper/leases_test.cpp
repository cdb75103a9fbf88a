#include "keeper/leases.hpp"

#include <gtest/gtest.h>

namespace vagus::keeper {
namespace {

Reply granted(Term term, Duration length, uint64_t epoch = 1) {
    return {Outcome::Done, "", epoch,
            Task{"q", "t", {1, 1}, "", Work::Leased, {"me", term, length}, ""}};
}

TEST(Leases, AQuestionIsAskedAgainEachSecondUntilItIsAnswered) {
    Leases leases;
    const uint64_t number = leases.ask(Take{"q", 9s}, 0s);
    ASSERT_EQ(leases.tick(0s).size(), 1u);
    EXPECT_EQ(leases.tick(999ms).size(), 0u);
    EXPECT_EQ(leases.next(), 1s);
    ASSERT_EQ(leases.tick(1s).size(), 1u);
    leases.hear(number, {Outcome::Nothing, "none", 1, {}}, 1500ms);
    leases.hear(number, {Outcome::Nothing, "none", 1, {}}, 1600ms);
    const auto over = leases.take_over();
    ASSERT_EQ(over.size(), 1u);
    EXPECT_EQ(over[0].reply->why, "none");
    EXPECT_EQ(leases.tick(9s).size(), 0u);
}

TEST(Leases, AQuestionThatNobodyAnswersFailsAfterHalfAMinute) {
    Leases leases;
    leases.ask(Take{"q", 9s}, 0s);
    for (int i = 0; i < 30; ++i) EXPECT_EQ(leases.tick(i * 1s).size(), 1u);
    EXPECT_TRUE(leases.take_over().empty());
    EXPECT_EQ(leases.tick(30s).size(), 0u);
    const auto over = leases.take_over();
    ASSERT_EQ(over.size(), 1u);
    EXPECT_FALSE(over[0].reply);
}

TEST(Leases, ALeaseCountsFromWhenItWasFirstAsked) {
    Leases leases;
    const uint64_t number = leases.ask(Take{"q", 9s}, 0s);
    leases.tick(0s);
    leases.tick(4s);
    leases.hear(number, granted({1, 2}, 9s), 5s);
    EXPECT_TRUE(leases.holds({1, 2}, 8999ms));
    EXPECT_FALSE(leases.holds({1, 2}, 9s));
    EXPECT_TRUE(leases.take_ended(8999ms).empty());
    EXPECT_EQ(leases.take_ended(9s), (std::vector<Term>{{1, 2}}));
    EXPECT_TRUE(leases.take_ended(9s).empty());
}

TEST(Leases, IsRenewedAtEachThirdFromWhenTheRenewalWasAsked) {
    Leases leases;
    leases.hear(leases.ask(Take{"q", 9s}, 0s), granted({1, 2}, 9s), 0s);
    EXPECT_TRUE(leases.tick(2999ms).empty());
    const auto asks = leases.tick(3s);
    ASSERT_EQ(asks.size(), 1u);
    EXPECT_EQ(std::get<Renew>(asks[0].request).term, (Term{1, 2}));
    leases.hear(asks[0].number, granted({1, 2}, 9s), 4s);
    EXPECT_TRUE(leases.holds({1, 2}, 11'999ms));
    EXPECT_FALSE(leases.holds({1, 2}, 12s));
    EXPECT_EQ(leases.take_over().size(), 1u);  // of the first question alone
}

TEST(Leases, ARenewalThatIsRefusedEndsTheLeaseAtOnce) {
    Leases leases;
    leases.hear(leases.ask(Take{"q", 9s}, 0s), granted({1, 2}, 9s), 0s);
    const auto asks = leases.tick(3s);
    leases.hear(asks.at(0).number, {Outcome::Refused, "over", 1, {}}, 4s);
    EXPECT_EQ(leases.take_ended(4s).size(), 1u);
}

TEST(Leases, FromASupersededKeeperNothingIsTaken) {
    Leases leases;
    const uint64_t number = leases.ask(Take{"q", 9s}, 0s);
    leases.heard_of(2, 0s);
    leases.hear(number, granted({1, 2}, 9s, 1), 1s);
    EXPECT_FALSE(leases.holds({1, 2}, 1s));
    leases.hear(number, granted({2, 1}, 9s, 2), 1s);
    EXPECT_TRUE(leases.holds({2, 1}, 1s));
}

// Its epoch is the calendar's where the broker has lost what it kept, and that clock may be wrong.
TEST(Leases, ALowerKeeperCountsWhenTheHigherOneIsGoneForLongerThanTheLongestLease) {
    Leases leases;
    const uint64_t first = leases.ask(Take{"q", 9s}, 0s);
    leases.hear(first, granted({4'000'000'000, 1}, 9s, 4'000'000'000), 0s);
    leases.heard_of(30, 61'199ms);
    leases.heard_of(4'000'000'000, 61'199ms);
    leases.heard_of(30, 122'398ms);
    uint64_t number = leases.ask(Take{"q", 9s}, 122'398ms);
    leases.hear(number, granted({30, 1}, 9s, 30), 122'398ms);
    EXPECT_FALSE(leases.holds({30, 1}, 122'398ms));
    leases.heard_of(30, 122'399ms);
    leases.hear(number, granted({30, 1}, 9s, 30), 122'399ms);
    EXPECT_TRUE(leases.holds({30, 1}, 122'399ms));
}

TEST(Leases, WhatIsFinishedIsNoLongerHeldNorToldAsEnded) {
    Leases leases;
    leases.hear(leases.ask(Take{"q", 9s}, 0s), granted({1, 2}, 9s), 0s);
    leases.ask(Finish{{1, 2}, "ok"}, 1s);
    EXPECT_FALSE(leases.holds({1, 2}, 1s));
    EXPECT_TRUE(leases.take_ended(9s).empty());
}

TEST(Leases, ALeaseThatNobodyWaitsForAnyMoreIsReleased) {
    Leases leases;
    const uint64_t number = leases.ask(Take{"q", 9s}, 0s);
    leases.cancel(number);
    leases.hear(number, granted({1, 2}, 9s), 1s);
    EXPECT_FALSE(leases.holds({1, 2}, 1s));
    EXPECT_TRUE(leases.take_over().empty());
    const auto asks = leases.tick(1s);
    ASSERT_EQ(asks.size(), 1u);
    EXPECT_EQ(std::get<Release>(asks[0].request).term, (Term{1, 2}));
}

TEST(Leases, OneQuestionMoreThanTheLimitIsRefused) {
    Leases leases;
    for (size_t i = 0; i < kQuestionsMax; ++i) EXPECT_NE(leases.ask(Take{"q", 9s}, 0s), 0u);
    EXPECT_EQ(leases.ask(Take{"q", 9s}, 0s), 0u);
}

}  // namespace
}  // namespace vagus::keeper
