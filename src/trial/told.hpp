// What a process that runs a set of tests is asked, and what it tells while it runs them: as lines
// of JSON for a pipe between our own processes.
//
//     send(format_order({.tests = {"/home/ann/hall/Wall.test.json"}, .results = "/tmp/results"}));
//     // then, from there:
//     const std::vector<PlannedTest> planned = read_planned(first);   // once
//     const SeedTold told = read_seed(next);                          // for each seed, as it ends
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trial/report.hpp"

namespace vagus::trial {

struct TestOrder {
    std::vector<std::string> tests;  // files
    std::string results;             // a folder for recordings of runs that failed
    bool scripts = false;            // lines of scripts are counted, too
    friend bool operator==(const TestOrder&, const TestOrder&) = default;
};

// Of each test of the order.
struct PlannedTest {
    SeedRange seeds = {};
    bool world = false;        // its runs are in one
    std::string refused = {};  // why it cannot be run; empty: it can
};

// What came of one seed.
struct SeedTold {
    size_t test = 0;  // of the order
    uint64_t seed = 0;
    std::string refused = {};    // why the test can have no such run, nor another one
    std::string trouble = {};    // why this one has no outcome: it crashed
    std::string recording = {};  // of one that failed; empty: none
    std::vector<Failure> failures = {};
    Coverage coverage = {};

    bool as_expected() const { return refused.empty() && trouble.empty() && failures.empty(); }
};

std::string format_order(const TestOrder& order);
TestOrder read_order(std::string_view text);
std::string format_planned(const std::vector<PlannedTest>& tests);
std::vector<PlannedTest> read_planned(std::string_view text);
std::string format_seed(const SeedTold& told);
SeedTold read_seed(std::string_view text);

}  // namespace vagus::trial
