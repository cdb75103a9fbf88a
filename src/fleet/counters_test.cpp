#include "fleet/counters.hpp"

#include <gtest/gtest.h>

namespace vagus::fleet {
namespace {

TEST(Numbers, OnceForEachRobotAndEpoch) {
    Numbers numbers;
    EXPECT_TRUE(numbers.is_new("r1", 1, 5));
    EXPECT_FALSE(numbers.is_new("r1", 1, 5));
    EXPECT_TRUE(numbers.is_new("r1", 2, 5));
    EXPECT_TRUE(numbers.is_new("r2", 1, 5));
    EXPECT_TRUE(numbers.is_new("r1", 1, 4)) << "one that came later than its follower";
}

TEST(Numbers, RememberTheLastOnes) {
    Numbers numbers;
    const auto count = static_cast<int64_t>(kNumbersRemembered);
    for (int64_t i = 1; i <= count; ++i) EXPECT_TRUE(numbers.is_new("r1", 1, i));
    EXPECT_FALSE(numbers.is_new("r1", 1, 1));
    EXPECT_TRUE(numbers.is_new("r1", 1, count + 1));
    EXPECT_TRUE(numbers.is_new("r1", 1, 1)) << "the oldest is forgotten";
    EXPECT_FALSE(numbers.is_new("r1", 1, count + 1));
}

TEST(Numbers, RememberTheSendersThatWereHeardLast) {
    Numbers numbers;
    numbers.is_new("first", 0, 1);
    for (size_t i = 1; i < kSendersRemembered; ++i) {
        numbers.is_new("r1", static_cast<int64_t>(i), 1);
    }
    EXPECT_FALSE(numbers.is_new("first", 0, 1)) << "it is used now";
    numbers.is_new("one more", 0, 1);
    EXPECT_EQ(numbers.senders(), kSendersRemembered);
    EXPECT_FALSE(numbers.is_new("first", 0, 1));
    EXPECT_TRUE(numbers.is_new("r1", 1, 1)) << "the one that was silent the longest";
}

TEST(Rates, TwentyOfANameInASecond) {
    Rates rates(1s);
    for (int64_t i = 0; i < kEventsASecond; ++i) EXPECT_TRUE(rates.allows("alarm", 10ms * i));
    EXPECT_FALSE(rates.allows("alarm", 999ms));
    EXPECT_TRUE(rates.allows("other", 999ms));
    EXPECT_TRUE(rates.allows("alarm", 1s));
}

// What a sender may send in the ten seconds that it is cut off comes at once.
TEST(Rates, TwoHundredOfANameInTenSeconds) {
    Rates rates(10s);
    for (int i = 0; i < 200; ++i) EXPECT_TRUE(rates.allows("alarm", 1ms * i));
    EXPECT_FALSE(rates.allows("alarm", 9'999ms));
    EXPECT_TRUE(rates.allows("alarm", 10s));
}

TEST(Rates, NamesAreForgottenWhenTheirSecondIsOver) {
    Rates rates(1s);
    for (size_t i = 0; i < kRatesRemembered; ++i) rates.allows(std::to_string(i), 0s);
    EXPECT_FALSE(rates.allows("one more", 500ms));
    EXPECT_TRUE(rates.allows("one more", 1s));
    EXPECT_EQ(rates.names(), 1u);
}

}  // namespace
}  // namespace vagus::fleet
