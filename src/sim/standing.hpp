// Does a robot have room where a world puts it? Exact geometry of what is fixed.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "sim/definitions.hpp"

namespace vagus::sim {

// As much as a robot may overlap something fixed, m: the physics push it out without a jerk.
constexpr double kStandsInMax = 0.005;

// The hull of a robot of that type, seen from above: a convex polygon, counter-clockwise.
std::span<const Point> outline_of(RobotType type);

// The fixed thing that the robot would overlap and how to fix that, as the end of a sentence: "the
// wall \"north\"; place one of them somewhere else"; nothing if it has room.
std::optional<std::string> stands_in(const RobotDefinition& robot, const WorldDefinition& world);

}  // namespace vagus::sim
