// Runs jobs in processes of their own, some at a time: what crashes or hangs in one is its own
// trouble, and all processors work.
//
//     run_jobs(count, 2, [](size_t i) { return run_one(i); },
//              [](size_t i, JobResult result) { keep(i, result); return true; });
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace vagus::cli {

struct JobResult {
    std::string text = {};     // what the job gave
    std::string trouble = {};  // how its process ended instead; empty: it gave its text
    double seconds = 0;        // of wall clock
};

constexpr int kJobsAtOnceMax = 256;

// `job` runs in a child, and its text is handed over; `done` is called here, in the order in which
// they end. False from `done`: no more of them are begun, and those that run are ended. Children
// end with this process. Gives false if they were ended because this process is to end
// (net/end_signal.hpp).
bool run_jobs(size_t count, int at_once, const std::function<std::string(size_t)>& job,
              const std::function<bool(size_t, JobResult)>& done);

// Within a job: goes on in a copy of its process. True in the copy, whose text is added to that of
// the job; false in the job itself, when the copy has ended. `trouble` is how it ended instead;
// empty: it gave its text.
bool continue_in_copy(std::string& trouble);

}  // namespace vagus::cli
