// Shares and what they say, against values that others have published or that are worked out by
// hand.
#include "trial/shares.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace vagus::trial;

namespace {

void expect_interval(const Share& share, double low, double high) {
    const Interval found = wilson(share);
    EXPECT_NEAR(found.low, low, 5e-5) << share.came << " of " << share.of;
    EXPECT_NEAR(found.high, high, 5e-5) << share.came << " of " << share.of;
}

// R. G. Newcombe, "Two-sided confidence intervals for the single proportion: comparison of seven
// methods", Statistics in Medicine 17 (1998), table I, method 3: the score interval.
TEST(Shares, WilsonGivesThePublishedIntervals) {
    expect_interval({81, 263}, 0.2553, 0.3662);
    expect_interval({15, 148}, 0.0624, 0.1605);
    expect_interval({0, 20}, 0, 0.1611);
    expect_interval({1, 29}, 0.0061, 0.1718);
}

TEST(Shares, NoneAndAllReachTheEnds) {
    EXPECT_EQ(wilson({0, 7}).low, 0);
    EXPECT_EQ(wilson({7, 7}).high, 1);
    EXPECT_EQ(wilson({}).low, 0);
    EXPECT_EQ(wilson({}).high, 1);
}

// Fisher's lady who tastes tea: 3 of 4 against 1 of 4. The tables with those sums have 16 of 70 for
// 3 and for 1, and 1 of 70 for 4 and for 0: as likely or less are 34 of 70.
TEST(Shares, TwoSharesOfOneChanceDifferAsOftenAsCounted) {
    EXPECT_NEAR(chance_of_same({3, 4}, {1, 4}), 34.0 / 70, 1e-9);
    EXPECT_NEAR(chance_of_same({4, 4}, {0, 4}), 2.0 / 70, 1e-9);
    EXPECT_NEAR(chance_of_same({5, 5}, {7, 7}), 1, 1e-9);
}

// 2 of 4 and 2 of 2 by 4 of 6: log(1/16 * 1) - log((2/3)^4 (1/3)^2) = log(729 / 256).
TEST(Shares, TwoChancesExplainMoreThanOne) {
    EXPECT_NEAR(gain_of_two({2, 4}, {2, 2}), std::log(729.0 / 256), 1e-12);
    EXPECT_EQ(gain_of_two({3, 6}, {4, 8}), 0);
}

// Half a try more on each side: chances 1.5 / 4 and 3.5 / 4. Two came and one did not.
TEST(Shares, WhatIsSeenBelongsToTheNearerOne) {
    EXPECT_NEAR(in_favour_of({1, 3}, {3, 3}, {2, 3}), 2 * std::log(1.5 / 3.5) + std::log(2.5 / 0.5),
                1e-12);
    EXPECT_LT(in_favour_of({10, 20}, {20, 20}, {20, 20}), 0);
    EXPECT_GT(in_favour_of({10, 20}, {20, 20}, {11, 20}), 0);
}

}  // namespace
