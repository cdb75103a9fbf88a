// At which instants of a run keyframes are kept (keyframes.hpp): close to each other before the
// newest instant, the further apart the longer ago. An instant that is left out is never wanted
// again: as the run goes on, keyframes only go.
//
//     for (const Time at : keyframe_instants(newest)) keep(at);
#pragma once

#include <cstddef>
#include <vector>

#include "base/time.hpp"

namespace vagus::record {

constexpr Duration kKeyframesApartMin = std::chrono::milliseconds(7500);
// Within the last hour: running on from the one before takes at most what so much takes.
constexpr Duration kKeyframesApartMax = std::chrono::seconds(120);
constexpr Duration kKeyframesHour = std::chrono::hours(1);
// Before the earliest of them the run begins at its beginning.
constexpr size_t kKeyframesMax = 64;

// For a run that has been at `newest`, by time; none of them is later.
std::vector<Time> keyframe_instants(Time newest);

}  // namespace vagus::record
