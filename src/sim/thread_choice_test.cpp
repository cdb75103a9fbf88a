#include "sim/thread_choice.hpp"

#include <gtest/gtest.h>

namespace vagus::sim {
namespace {

using namespace std::chrono_literals;

// Passes pieces that cost so much real time for one thread and for all; gives the real time.
Duration pass(ThreadChoice& choice, int pieces, Duration alone, Duration together) {
    Duration real{};
    for (int i = 0; i < pieces; ++i) {
        const Duration took = choice.one() ? alone : together;
        real += took;
        choice.took(kThreadTrial, took);
    }
    return real;
}

TEST(ThreadChoice, BeginsWithOneAndTriesBothInTurn) {
    ThreadChoice choice;
    EXPECT_TRUE(choice.one());
    choice.took(kThreadTrial - 1ms, 5ms);
    EXPECT_TRUE(choice.one());  // the piece is not over
    choice.took(1ms, 1ms);
    EXPECT_FALSE(choice.one());
    choice.took(kThreadTrial, 6ms);
    EXPECT_TRUE(choice.one());
}

TEST(ThreadChoice, TakesWhatIsFaster) {
    ThreadChoice gains, loses, ties;
    pass(gains, 2 * kThreadTrials, 10ms, 6ms);
    EXPECT_FALSE(gains.one());
    pass(loses, 2 * kThreadTrials, 10ms, 20ms);
    EXPECT_TRUE(loses.one());
    pass(ties, 2 * kThreadTrials, 10ms, 10ms);
    EXPECT_TRUE(ties.one());
}

// 1,000 pieces, 50 s: one thread alone takes 10 s.
TEST(ThreadChoice, CostsLessThanFivePercentWhereAllAreTwiceAsSlow) {
    ThreadChoice choice;
    EXPECT_LT(pass(choice, 1000, 10ms, 20ms), Duration(10s) * 105 / 100);
}

TEST(ThreadChoice, CostsLessThanFivePercentWhereAllAreTwiceAsFast) {
    ThreadChoice choice;
    EXPECT_LT(pass(choice, 1000, 20ms, 10ms), Duration(10s) * 105 / 100);
}

TEST(ThreadChoice, ChangesWhenOthersComeAndGo) {
    ThreadChoice choice;
    pass(choice, 100, 20ms, 10ms);
    EXPECT_FALSE(choice.one());
    pass(choice, 2 * kThreadTrialEvery, 20ms, 30ms);
    EXPECT_TRUE(choice.one());
    pass(choice, 2 * kThreadTrialEvery, 20ms, 10ms);
    EXPECT_FALSE(choice.one());
}

// A piece in which the machine was busy with something else is not what is judged by at first.
TEST(ThreadChoice, OneSlowPieceDoesNotDecide) {
    ThreadChoice choice;
    choice.took(kThreadTrial, 100ms);
    choice.took(kThreadTrial, 12ms);
    pass(choice, 2 * kThreadTrials - 2, 10ms, 12ms);
    EXPECT_TRUE(choice.one());
}

}  // namespace
}  // namespace vagus::sim
