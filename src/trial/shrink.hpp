// Of faults with which a run is not as expected, the smallest set that does the same: fewer faults
// first, then shorter and weaker ones; in as few runs as it can.
//
//     const auto breaks = [&](const Faults& faults) -> std::optional<Time> {
//         return when_it_failed(run(faults));
//     };
//     const Shrunk least = shrink(faults, failed_at, breaks);
//     show(least.faults, least.runs);
//
// A run is the same up to the instant at which it failed, whatever breaks behind it: so what begins
// later is left out, and what lasts longer ends there, without a run.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/time.hpp"
#include "sim/chaos.hpp"

namespace vagus::trial {

constexpr size_t kShrinkRunsMax = 100;                              // then it is small enough
constexpr Duration kShortestFault = std::chrono::milliseconds(20);  // found so exactly
constexpr int kHalvingsMax = 5;                                     // of the strength of one

using Faults = std::vector<sim::ChaosFault>;
// When a run with these faults was first not as expected; nothing if it is as expected.
using Breaks = std::function<std::optional<Time>(const Faults&)>;

struct Shrunk {
    Faults faults;
    Time failed_at{};
    size_t runs = 0;
};

// The run with these faults failed at that instant.
Shrunk shrink(Faults faults, Time failed_at, const Breaks& breaks,
              size_t runs_max = kShrinkRunsMax);

}  // namespace vagus::trial
