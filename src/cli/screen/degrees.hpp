// How a direction is shown to people, on every page and line: in whole degrees, above -180 and at
// most 180, however often a robot has turned.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace vagus::cli {

inline int degrees_shown(double radians) {
    const int64_t whole =
        std::llround(std::remainder(radians, 2 * std::numbers::pi) * 180 / std::numbers::pi);
    return static_cast<int>(whole <= -180 ? whole + 360 : whole);
}

}  // namespace vagus::cli
