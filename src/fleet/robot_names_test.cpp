#include "fleet/robot_names.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace vagus::fleet {
namespace {

using Names = std::vector<std::string>;

TEST(RobotNames, ARangeIsEachOfItsNames) {
    EXPECT_EQ(names_in("t9..t11"), (Names{"t9", "t10", "t11"}));
    EXPECT_EQ(names_in("t-2..t-2"), Names{"t-2"});
    EXPECT_EQ(names_in("1..3"), (Names{"1", "2", "3"}));
    EXPECT_EQ(names_in("t1..t1000").size(), kNamesInRangeMax);
}

TEST(RobotNames, WhatIsNoRangeIsAName) {
    for (const char* name : {"t1", "t3..t1", "t1..r3", "t..t3", "t1..", "..", "t01..t03", "",
                             "t1..t1001", "t1..t99999999999999"}) {
        EXPECT_EQ(names_in(name), Names{name});
    }
}

TEST(RobotNames, NumbersAreInTheirOrder) {
    Names names = {"t10", "alice", "t2", "t02", "r3", "bob", "t1"};
    std::ranges::sort(names, counted_before);
    EXPECT_EQ(names, (Names{"alice", "bob", "r3", "t1", "t2", "t10", "t02"}));
}

}  // namespace
}  // namespace vagus::fleet
