// Planted decisions: runs that are only chances over time. What is asked of each continuation is
// answered by its own seed, so every test is the same each time.
#include "trial/turning.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "base/rng.hpp"
#include "trial/turning_text.hpp"

using namespace vagus;
using namespace vagus::trial;
using namespace std::chrono_literals;

namespace {

// The chance at each instant that it becomes true later.
struct Planted {
    std::function<double(Time)> chance;
    int asked = 0;
    std::vector<Continuation> all = {};

    Result<std::vector<bool>> answer(const std::vector<Continuation>& continuations) {
        std::vector<bool> came;
        for (const Continuation& one : continuations) {
            all.push_back(one);
            came.push_back(SplitMix64(one.seed).unit() < chance(one.at));
        }
        asked += static_cast<int>(continuations.size());
        return came;
    }
};

Turning turning_of(Planted& planted, const TurningQuestion& question) {
    auto found = find_turning(question, [&](const auto& all) { return planted.answer(all); });
    EXPECT_TRUE(found.ok());
    return found.value();
}

// One decision: before it `early`, from `at` on `late`.
std::function<double(Time)> step(Time at, double early, double late) {
    return [=](Time now) { return now < at ? early : late; };
}

// It is decided while the instant 7.411 s passes: continued from 7.410 s it is open, from 7.411 s
// it is not.
TEST(Turning, ADecisionIsFoundToTheMillisecond) {
    for (const double early : {0.1, 0.3, 0.5, 0.8}) {
        SCOPED_TRACE(early);
        Planted planted{step(7411ms, early, 1)};
        const Turning turning = turning_of(planted, {.end = 20s, .came = true});
        ASSERT_TRUE(turning.turn);
        EXPECT_TRUE(turning.turn->narrowed);
        EXPECT_EQ(turning.turn->before.at, 7410ms);
        EXPECT_EQ(turning.turn->after.at, 7411ms);
        EXPECT_EQ(turning.continuations, planted.asked);
    }
}

// It did not become true: 0 afterwards, and 0 at the end.
TEST(Turning, WhatWasAvoidedIsFoundLikewise) {
    for (const double early : {0.25, 0.5, 0.9}) {
        SCOPED_TRACE(early);
        Planted planted{step(12s, early, 0)};
        const Turning turning = turning_of(planted, {.end = 20s, .came = false});
        ASSERT_TRUE(turning.turn);
        EXPECT_EQ(turning.turn->before.at, 11999ms);
        EXPECT_EQ(turning.turn->after.at, 12s);
        // Both are kept, from before it.
        ASSERT_TRUE(turning.turn->with && turning.turn->without);
        EXPECT_LE(turning.turn->with->at, 11999ms);
        EXPECT_LE(turning.turn->without->at, 11999ms);
    }
}

// In the first and in the last millisecond, where the grid has one instant on one side.
TEST(Turning, TheBeginningAndTheEndAreFound) {
    Planted first{step(1ms, 0.5, 1)};
    EXPECT_EQ(turning_of(first, {.end = 20s, .came = true}).turn->after.at, 1ms);
    Planted last{step(20s, 0.5, 1)};
    const Turning turning = turning_of(last, {.end = 20s, .came = true});
    ASSERT_TRUE(turning.turn);
    EXPECT_EQ(turning.turn->before.at, 19999ms);
    EXPECT_EQ(turning.turn->after.at, 20s);
    EXPECT_TRUE(turning.turn->after.is_end);
}

// A third, two thirds, all: the change at 15 s is as large as the first, and one of them is told;
// with 5 %, 30 % and 100 % it is the second.
TEST(Turning, OfSeveralTheLargestIsTold) {
    Planted planted{[](Time now) { return now < 5s ? 0.05 : now < 15s ? 0.3 : 1; }};
    const Turning turning = turning_of(planted, {.end = 20s, .came = true});
    ASSERT_TRUE(turning.turn);
    EXPECT_EQ(turning.turn->after.at, 15s);
    EXPECT_EQ(turning.steps.size(), 2u);
}

TEST(Turning, NothingIsContinuedWhereItWasSoAtTheBeginning) {
    Planted planted{step(0s, 1, 1)};
    const Turning turning = turning_of(planted, {.end = 0s, .came = true});
    EXPECT_FALSE(turning.turn);
    EXPECT_EQ(turning.curve.size(), 1u);
    EXPECT_EQ(planted.asked, 0);
    EXPECT_EQ(turning_sentence(turning),
              "not decided by chance: there is no instant before it to continue from");
}

TEST(Turning, AFlatCurveIsNotDecidedByChance) {
    Planted always{[](Time) { return 1; }};
    const Turning all = turning_of(always, {.end = 20s, .came = true});
    EXPECT_FALSE(all.turn);
    EXPECT_EQ(all.all(), (Share{32 * 20, 32 * 20}));
    Planted never{[](Time) { return 0; }};
    const Turning none = turning_of(never, {.end = 20s, .came = false});
    EXPECT_FALSE(none.turn);
    EXPECT_EQ(none.all(), (Share{0, 32 * 20}));
    EXPECT_EQ(none.curve.size(), kInstantsMax);
}

// The same everywhere is no turn, however it scatters: with kSignificance 0.01 at most a few of a
// hundred may be told all the same. The end is as the rest would have it.
TEST(Turning, NoiseIsNoTurn) {
    int told = 0;
    for (uint64_t world = 0; world < 100; ++world) {
        std::vector<Point> curve;
        SplitMix64 random(world);
        for (int i = 0; i < 32; ++i) {
            Point point{.at = 1s * i, .share = {0, 20}};
            for (int k = 0; k < 20; ++k) point.share.came += random.unit() < 0.5 ? 1 : 0;
            curve.push_back(point);
        }
        told += find_steps(curve).empty() ? 0 : 1;
    }
    EXPECT_LE(told, 4);
}

// From 8 s to 12 s the chance rises slowly: no instant in between can be told from its neighbours,
// and the answer says so.
TEST(Turning, AChangeLittleByLittleIsToldAsThat) {
    Planted planted{[](Time now) {
        return now < 8s ? 0.2 : now > 12s ? 1 : 0.2 + 0.8 * (seconds_of(now) - 8) / 4;
    }};
    const Turning turning = turning_of(planted, {.end = 20s, .came = true, .tries = 100});
    ASSERT_TRUE(turning.turn);
    EXPECT_GE(turning.turn->before.at, 7500ms);
    EXPECT_LE(turning.turn->after.at, 12500ms);
}

// Seeds are of their instant and try, and no two are the same.
TEST(Turning, EachContinuationHasASeedOfItsOwn) {
    Planted planted{step(3s, 0.5, 1)};
    turning_of(planted, {.end = 4s, .came = true});
    std::set<uint64_t> seeds;
    for (const Continuation& one : planted.all) seeds.insert(one.seed);
    EXPECT_EQ(seeds.size(), planted.all.size());
    EXPECT_EQ(continuation_seed(3s, 7), continuation_seed(3s, 7));
}

// A run of 10 ms has 10 instants, one of 0 has none.
TEST(Turning, AShortRunHasAShortGrid) {
    Planted planted{[](Time) { return 1; }};
    EXPECT_EQ(turning_of(planted, {.end = 10ms, .came = true}).curve.size(), 11u);
    EXPECT_EQ(turning_of(planted, {.end = 0ms, .came = true}).curve.size(), 1u);
}

TEST(Turning, AnErrorEndsTheSearch) {
    const auto failed = find_turning({.end = 1s}, [](const auto&) -> Result<std::vector<bool>> {
        return Error{Code::Unavailable, "no process"};
    });
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().what, "no process");
}

}  // namespace
