#include "fleet/tell_list.hpp"

#include <gtest/gtest.h>

#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

using List = std::vector<Tells>;
const Tells kX{"drive", "x"}, kY{"drive", "y"};

TEST(TellList, WhatWasAskedForIsToldForAMinute) {
    TellList list({kX});
    EXPECT_TRUE(list.add(kY, 1s));
    EXPECT_EQ(list.all(), (List{kX, kY}));
    EXPECT_FALSE(list.forget_old(61s - 1us));
    EXPECT_EQ(list.next(), 61s);
    EXPECT_TRUE(list.forget_old(61s));
    EXPECT_EQ(list.all(), List{kX});
    EXPECT_EQ(list.next(), Time::max());
}

TEST(TellList, AskedAgainItLastsLonger) {
    TellList list({});
    EXPECT_TRUE(list.add(kY, 0s));
    EXPECT_TRUE(list.add(kY, 30s));
    EXPECT_FALSE(list.forget_old(60s));
    EXPECT_EQ(list.all(), List{kY});
}

TEST(TellList, OneThatTheProjectTellsIsToldOnce) {
    TellList list({kX});
    EXPECT_TRUE(list.add(kX, 0s));
    EXPECT_EQ(list.all(), List{kX});
}

TEST(TellList, OneMoreThanTheLimitIsRefused) {
    TellList list({});
    for (size_t i = 0; i < kTellMax; ++i) EXPECT_TRUE(list.add({"n", std::to_string(i)}, 0s));
    EXPECT_FALSE(list.add(kX, 0s));
    EXPECT_TRUE(list.add({"n", "0"}, 0s));
}

}  // namespace
}  // namespace vagus::fleet
