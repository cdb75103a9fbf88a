// Walls in what the distance sensor hears: pure geometry, in the sensor's frame (x ahead, y to the
// left; cm, degrees).
#pragma once

#include <optional>
#include <vector>

#include "toolbox/carbot/distance_map.hpp"

namespace vagus::toolbox::carbot {

struct Wall {
    double distance_cm = 0;    // from the sensor to the line
    double direction_deg = 0;  // of the line: -90 (excluded) to 90; 0 is parallel to the robot
    bool left = false;         // the side it is on when the robot has turned parallel to it
};

// The wall that the nearest echo belongs to: a line through that echo and its neighbours, as far as
// they are one surface. Nothing where there is no echo, or the nearest one stands alone.
std::optional<Wall> nearest_wall(const std::vector<Echo>& echoes);

// The line through two echoes; nothing if one of them is none, or both are at one place.
std::optional<Wall> wall_through(const Echo& one, const Echo& other);

// -180 (excluded) to 180.
double normal_angle(double degrees);

}  // namespace vagus::toolbox::carbot
