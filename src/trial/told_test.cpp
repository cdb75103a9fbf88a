#include "trial/told.hpp"

#include <gtest/gtest.h>

namespace vagus::trial {
namespace {

TEST(Told, AnOrderComesAsItWasGiven) {
    const TestOrder order{
        .tests = {"/a \"b\"/One.test.json", "/Two.test.json"}, .results = "/r", .scripts = true};
    EXPECT_EQ(read_order(format_order(order)), order);
}

TEST(Told, WhatIsPlannedComesAsItWasTold) {
    const auto planned = read_planned(
        format_planned({{.seeds = {3, 7}, .world = true}, {.refused = "a.json:1:2: no plan"}}));
    ASSERT_EQ(planned.size(), 2u);
    EXPECT_EQ(planned[0].seeds.first, 3u);
    EXPECT_EQ(planned[0].seeds.last, 7u);
    EXPECT_TRUE(planned[0].world);
    EXPECT_EQ(planned[1].refused, "a.json:1:2: no plan");
}

TEST(Told, ASeedComesAsItWasToldWithItsFailuresAndCounts) {
    SeedTold told{.test = 2, .seed = 40, .trouble = "it \n crashed", .recording = "/r/x.mcap"};
    told.failures = {{.at = {4, 7}, .t = 12.345678, .expected = "ends OK", .what = "é", .help = ""},
                     {.at = {5, 1}, .t = 3, .expected = "a", .what = "b", .help = "c"}};
    told.coverage.plans["p"].actors = {{"go", 3}, {"stay", 0}};
    told.coverage.scripts["s"].lines = {{4, 2}};
    const SeedTold read = read_seed(format_seed(told));
    EXPECT_EQ(read.test, 2u);
    EXPECT_EQ(read.seed, 40u);
    EXPECT_EQ(read.trouble, told.trouble);
    EXPECT_EQ(read.recording, told.recording);
    EXPECT_EQ(read.failures, told.failures);
    EXPECT_EQ(format_coverage(read.coverage), format_coverage(told.coverage));
    EXPECT_FALSE(read.as_expected());
}

}  // namespace
}  // namespace vagus::trial
