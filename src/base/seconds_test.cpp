#include "base/seconds.hpp"

#include <gtest/gtest.h>

namespace vagus {
namespace {

using namespace std::chrono_literals;

TEST(Seconds, HaveSixDecimals) {
    EXPECT_EQ(seconds_text(0us), "0.000000");
    EXPECT_EQ(seconds_text(42us), "0.000042");
    EXPECT_EQ(seconds_text(4250ms), "4.250000");
    EXPECT_EQ(seconds_text(3600s), "3600.000000");
    EXPECT_EQ(seconds_text(-500ms), "-0.500000");
}

TEST(Seconds, AreRoundedToMicroseconds) {
    EXPECT_EQ(from_seconds(0.1), 100ms);
    EXPECT_EQ(from_seconds(0.0000014), 1us);
    EXPECT_EQ(from_seconds(0.0000016), 2us);
    EXPECT_EQ(from_seconds(-0.5), -500ms);
}

}  // namespace
}  // namespace vagus
