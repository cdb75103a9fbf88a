// A test with faults: the file that `vagus test --chaos` writes of what it has found.
//
//     const auto written = TRY(with_chaos(test, text, {.seed = 7, .faults = least.faults},
//                                         "test-results/Wall.chaos-4.test.json"));
//     TRY(write_file("test-results/Wall.chaos-4.test.json", written));
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "trial/shrink.hpp"
#include "trial/test_file.hpp"

namespace vagus::trial {

struct Breaking {
    uint64_t seed = 1;
    Faults faults;
};

// The text of the test, which has that content, with the faults instead of its own and that seed
// only, as a file at `path`, from where its paths count. The Error says that a path of the test
// cannot be seen from there.
Result<std::string> with_chaos(const TestFile& test, std::string_view text,
                               const Breaking& breaking, const std::string& path);

}  // namespace vagus::trial
