// How to steer along a wall: of all curves that the robot could drive now, the one along which its
// distance from what the map shows will be the best. Pure geometry.
//
//     rover.steer(steer_along(map, rover.pose(), {.distance_cm = 30, .speed_cm = 20, .gain = 1}));
//
// So it comes near and goes parallel, goes around the end of a wall at the same distance, and turns
// from one wall into the next, all by one rule.
#pragma once

#include "toolbox/carbot/wall_map.hpp"

namespace vagus::toolbox::carbot {

struct AlongWall {
    double distance_cm = 0;  // from the side of the hull
    double speed_cm = 0;     // a second, straight on; slower in curves
    double gain = 1;         // the higher, the sharper it steers
};

Steering steer_along(const WallMap& map, const Pose& from, const AlongWall& goal);

}  // namespace vagus::toolbox::carbot
