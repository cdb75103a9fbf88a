// Runs a test of behaviour with one seed: in virtual time, in this process.
//
//     const TestFile test = TRY(read_test(text, path));
//     const Outcome outcome = TRY(run_trial(test, 7, {}));  // seed 7
//     if (!outcome.as_expected()) show(outcome);
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "trial/coverage.hpp"
#include "trial/judge.hpp"
#include "trial/starts.hpp"
#include "trial/test_file.hpp"

namespace vagus::trial {

struct TrialOptions {
    bool scripts = false;  // count lines and branches of scripts, which takes several times as long
    std::string record = {};  // a file for the recording; empty: none
    std::string chaos = {};   // of RunWords, instead of what the test says; empty: as it says
};

struct Outcome {
    uint64_t seed = 0;
    std::vector<Verdict> verdicts = {};  // of the expectations, in their order
    Time end{};
    std::string ended = {};                    // one of ways_to_end()
    std::string message = {};                  // of an error
    std::vector<std::string> poses = {};       // where robots began, if that was drawn: of --pose
    std::vector<sim::ChaosFault> faults = {};  // of the run
    Coverage coverage = {};

    bool as_expected() const {
        return std::ranges::all_of(verdicts, [](const Verdict& one) { return one.as_expected; });
    }
    // When it was first known that it is not.
    Time failed_at() const;
};

// The Error says why there can be no such run: it begins with the place in the test where that is
// what is wrong.
Result<Outcome> run_trial(const TestFile& test, uint64_t seed, const TrialOptions& options);

// One line of JSON, for a pipe between our own processes, and back.
std::string format_outcome(const Outcome& outcome);
Outcome read_outcome(std::string_view text);

}  // namespace vagus::trial
