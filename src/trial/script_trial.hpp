// Runs a test of behaviour that has no plan, with one seed: its world and the scripts of its
// robots, in virtual time, up to its max_time. They are there at time 0, as beside a plan and in
// the studio (docs/decisions/0083). Robots that have projects of their own run these, as in
// `vagus sim`.
//
//     if (test.plan.empty()) outcome = TRY(run_script_trial(test, 7, {}));
#pragma once

#include "trial/trial.hpp"

namespace vagus::trial {

// Called by run_trial(), and as that.
Result<Outcome> run_script_trial(const TestFile& test, uint64_t seed, const TrialOptions& options);

}  // namespace vagus::trial
