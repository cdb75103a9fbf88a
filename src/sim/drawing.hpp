// What robots show beside their shape: lights, and where their sensors look. Plain values for
// code that draws a world.
#pragma once

#include <string_view>

#include "sim/definitions.hpp"

namespace vagus::sim {

// A light of a robot: where it sits (in the frame of the robot: x ahead, y to the left) and what it
// shows now. Black is off.
struct Lamp {
    std::string_view name;  // "leds.top", "leds.circle"; lives as long as the program
    Point at;
    Colour colour;
};

// What a distance sensor looks along, in the world.
struct Beam {
    Point from;
    Point to;  // where it ends: on what was hit, or at the end of its range
    bool hit = false;
};

}  // namespace vagus::sim
