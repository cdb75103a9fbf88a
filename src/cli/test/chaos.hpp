// vagus test --chaos: tests whose runs are as expected are run again while things break, and the
// first set of faults that one does not survive is shrunk and written as a test.
//
//     const ChaosTries tries = TRY(parse_chaos_tries("20:lost,hung"));
//     const size_t broken = try_chaos(results, tries);   // results[0].faults: what came of each
#pragma once

#include <string>
#include <vector>

#include "base/result.hpp"
#include "sim/chaos.hpp"
#include "trial/report.hpp"

namespace vagus::cli {

constexpr uint64_t kChaosSetsMax = 10'000;  // of one test
constexpr size_t kChaosInSet = 4;           // faults: 1 in the first set, 2 in the second …

struct ChaosTries {
    uint64_t sets = 0;                       // of each test; 0: none
    std::vector<sim::ChaosKind> kinds = {};  // of these only; empty: of all
    int at_once = 1;
    std::string results = {};  // the folder for tests and recordings
};

// "N" or "N:KIND,KIND". The Error says what was expected.
Result<ChaosTries> parse_chaos_tries(const std::string& text);

// Of tests that have a world and no faults of their own, and whose runs were as expected. Tells
// what came of each, and adds what came of each set to its result. The number of tests that did not
// survive; 0, and nothing half-written, where this process is to end (net/end_signal.hpp).
size_t try_chaos(std::vector<trial::TestResult>& results, const ChaosTries& tries);

// Where in the folder the files of a test go: FOLDER/NAME. Two tests of one name have their own
// folder in it.
std::string result_stem(const std::vector<trial::TestResult>& all, const trial::TestFile& test,
                        const std::string& folder);

}  // namespace vagus::cli
