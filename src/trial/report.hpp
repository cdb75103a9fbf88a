// What came of a set of tests, as programs read it: JUnit XML.
//
//     TRY(write_file("junit.xml", format_junit(suites)));
#pragma once

#include <string>
#include <vector>

#include "trial/trial.hpp"

namespace vagus::trial {

// One seed of a test.
struct SeedResult {
    uint64_t seed = 0;
    Outcome outcome = {};        // unless `trouble` says that there is none
    std::string trouble = {};    // why it could not be run, or that it crashed
    std::string recording = {};  // of one that failed; empty: none
    double seconds = 0;          // of wall clock
};

// One set of faults with which a seed of it was tried.
struct FaultsResult {
    std::string words = {};  // of --chaos, which break the same things again
    SeedResult result = {};
};

struct TestResult {
    TestFile test;
    std::vector<SeedResult> seeds;
    std::vector<FaultsResult> faults = {};
};

bool as_expected(const SeedResult& result);

// One expectation that did not hold in one run.
struct Failure {
    Place at = {};  // of it in the test
    double t = 0;   // s: when that was known
    std::string expected = {};
    std::string what = {};  // the values then
    std::string help = {};  // of the test
    friend bool operator==(const Failure&, const Failure&) = default;
};
std::vector<Failure> failures_of(const TestFile& test, const Outcome& outcome);

// What is wrong with one seed: a line for each expectation that failed, without a newline at the
// end, each beginning with its place.
std::string describe_failure(const TestFile& test, const SeedResult& result);

constexpr std::string_view kJunitBegins =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
// A test suite for each test, a test case for each seed, and for each set of faults (the schema of
// Ant's and Jenkins' JUnit reports).
std::string format_junit(const std::vector<TestResult>& results);

}  // namespace vagus::trial
