// Where the robot of a test begins, where its "starts" leave that to the seed.
//
//     if (test.starts) poses.push_back(TRY(draw_start(test, 7)));  // "carbot=1.2,0.8,90"
#pragma once

#include <cstdint>
#include <string>

#include "base/result.hpp"
#include "trial/test_file.hpp"

namespace vagus::trial {

constexpr int kStartsTriedMax = 1000;  // places for a robot that are drawn at most

// What `--pose` takes. The test has "starts". The Error names the part of the test that is wrong.
Result<std::string> draw_start(const TestFile& test, uint64_t seed);

}  // namespace vagus::trial
