// Time as Vagus counts it: whole microseconds since the start of a run (or of the process, at the
// rim). Nothing below `net` asks for the time; it is handed in.
#pragma once

#include <chrono>

namespace vagus {

using Duration = std::chrono::microseconds;
using Time = Duration;  // since the start; a point and a length never meet in one formula without a
                        // name saying which

constexpr double seconds_of(Duration time) {
    return std::chrono::duration<double>(time).count();
}

}  // namespace vagus
