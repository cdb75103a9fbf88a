// How far the hull of a robot is from the nearest thing in its way: exact geometry on what a world
// shows of itself, apart from the simulator's own.
//
//     const double gap = clearance(world, robot, pose);   // metres; 0: it touches
#pragma once

#include "sim/world.hpp"

namespace vagus::samples {

// As if `robot` stood at `pose`. What counts: objects that can be in the way, and the walls around;
// other robots do not.
double clearance(const sim::World& world, const sim::RobotView& robot, const sim::Pose& pose);

}  // namespace vagus::samples
