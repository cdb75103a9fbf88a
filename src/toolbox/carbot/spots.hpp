// Where the surfaces are that the distance sensor hears. Its cone is wide: it tells how far the
// nearest thing within 12 degrees of its direction is, not where in there. What it tells in the
// directions beside gives that away: a surface that is nearer there is met at that edge of the
// cone.
//
//     std::vector<Sounding> sweep = …;          // from right to left, or from left to right
//     for (const Spot& spot : spots_of(sweep)) …
//
// Centimetres and degrees, in the frame that the poses are in.
#pragma once

#include <vector>

#include "toolbox/carbot/body.hpp"
#include "toolbox/carbot/distance_map.hpp"

namespace vagus::toolbox::carbot {

struct Spot {
    double x_cm = 0;
    double y_cm = 0;
};

// What was heard, and where the robot was then.
struct Sounding {
    Pose from;
    Echo echo;
};

// `angle_deg` and `distance_cm` are from the sensor.
Spot spot_of(const Pose& robot, const Echo& echo);

// Spots of surfaces. Directions in which nothing was heard give none, nor do those of which nobody
// can tell where in the cone the surface is: in the depth of a corner.
std::vector<Spot> spots_of(const std::vector<Sounding>& sweep);

// The place in the frame of a robot: x ahead, y to the left.
Spot seen_from(const Pose& robot, const Spot& spot);

// And back: a place in the frame of a robot in that of its pose.
Spot placed(const Pose& robot, const Spot& spot);

double sine(double degrees);
double cosine(double degrees);

}  // namespace vagus::toolbox::carbot
