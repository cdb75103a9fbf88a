#include "net/pace.hpp"

#include <gtest/gtest.h>

namespace vagus::net {
namespace {

using namespace std::chrono_literals;

TEST(Pace, NobodyWaitsForAReceiverThatIsNotBehind) {
    Pace pace;
    EXPECT_FALSE(pace.worth_waiting_for(0ms, 0));
    EXPECT_FALSE(pace.worth_waiting_for(0ms, kBehindBytes - 1));
    EXPECT_TRUE(pace.worth_waiting_for(0ms, kBehindBytes));
}

TEST(Pace, AReceiverThatTakesNothingIsWaitedForOnePeriodOnly) {
    Pace pace;
    EXPECT_TRUE(pace.worth_waiting_for(0ms, kBehindBytes));
    EXPECT_TRUE(pace.worth_waiting_for(49ms, kBehindBytes));
    EXPECT_FALSE(pace.worth_waiting_for(50ms, kBehindBytes));
    EXPECT_FALSE(pace.worth_waiting_for(1000ms, kBehindBytes));
}

TEST(Pace, AReceiverThatTakesEnoughInEachPeriodIsWaitedFor) {
    Pace pace;
    Time now = 0ms;
    EXPECT_TRUE(pace.worth_waiting_for(now, kBehindBytes));
    for (int period = 0; period < 10; ++period) {
        pace.took(kPaceBytes);
        now += kPacePeriod;
        EXPECT_TRUE(pace.worth_waiting_for(now, kBehindBytes));
    }
    pace.took(kPaceBytes - 1);
    EXPECT_FALSE(pace.worth_waiting_for(now + kPacePeriod, kBehindBytes));
}

TEST(Pace, AReceiverThatCaughtUpIsWaitedForAgain) {
    Pace pace;
    EXPECT_TRUE(pace.worth_waiting_for(0ms, kBehindBytes));
    EXPECT_FALSE(pace.worth_waiting_for(60ms, kBehindBytes));
    EXPECT_FALSE(pace.worth_waiting_for(70ms, 0));
    EXPECT_TRUE(pace.worth_waiting_for(80ms, kBehindBytes));
}

}  // namespace
}  // namespace vagus::net
