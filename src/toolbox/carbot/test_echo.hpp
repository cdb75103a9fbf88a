// What Carbot's distance sensor hears of an endless wall, for tests of what reads its echoes.
#pragma once

#include <cmath>

#include "toolbox/carbot/distance_map.hpp"
#include "toolbox/carbot/walls.hpp"

namespace vagus::toolbox::carbot {

constexpr double kDegree = 3.14159265358979 / 180;

// A wall at `distance` from the sensor, whose nearest point lies in the direction `normal`
// (docs/carbot.md, node range): nothing at more of a slant than 60 degrees.
inline Echo look_at(double distance, double normal, double angle) {
    const double off = std::abs(normal_angle(angle - normal)) - 12;
    if (off > 60) return {angle, 0};
    return {angle, off <= 0 ? distance : distance / std::cos(off * kDegree)};
}

}  // namespace vagus::toolbox::carbot
