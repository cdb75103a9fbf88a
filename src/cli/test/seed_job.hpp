// One seed of a test, run in a process of its own (pool.hpp): what that process says, and what is
// made of it here. A run that is not as expected is run once more, to be recorded.
//
//     run_jobs(count, 2, [&](size_t i) { return work_seed(test, i, {.recording = "i.mcap"}); },
//              [&](size_t i, JobResult result) {
//                  take(read_seed_work(i, std::move(result)));
//                  return true;
//              });
#pragma once

#include <cstdint>
#include <string>

#include "cli/test/pool.hpp"
#include "trial/report.hpp"

namespace vagus::cli {

struct SeedWork {
    bool scripts = false;   // their lines are counted
    std::string recording;  // the file for that of a run that failed; its folder is made
};

// In the process of the seed.
std::string work_seed(const trial::TestFile& test, uint64_t seed, const SeedWork& work);

// What a process that was ended has left of such a file; a whole recording stays.
void delete_half_recording(const std::string& path);

struct SeedDone {
    trial::SeedResult result = {};
    std::string refused = {};  // why the test can have no such run; empty: it has
};
SeedDone read_seed_work(uint64_t seed, JobResult job);

}  // namespace vagus::cli
