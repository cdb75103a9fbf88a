// Walls in what the distance sensor hears: pure geometry, seen from the sensor (cm, degrees
// counter-clockwise from ahead).
//
// The sensor hears the nearest of all that lies in its cone. So of a wall at the distance d, whose
// nearest point lies in the direction n, a look in the direction a gives d / cos(|a - n| - 12), and
// just d where n is in the cone.
#pragma once

#include <optional>
#include <vector>

#include "toolbox/carbot/distance_map.hpp"

namespace vagus::toolbox::carbot {

constexpr double kConeDeg = 12;   // to each side of where the sensor looks (docs/carbot.md)
constexpr double kGrazeDeg = 60;  // beyond that from its normal a wall throws nothing back

struct Wall {
    double distance_cm = 0;
    double normal_deg = 0;  // the direction of its nearest point

    // How far to turn to be parallel to it, with the wall on that side.
    double turn_to_have_it_right() const;
    double turn_to_have_it_left() const;
};

// The wall that fits all of these echoes best. Nothing without two echoes that are something.
std::optional<Wall> fit_wall(const std::vector<Echo>& echoes);

// Where a wall counts.
struct Sector {
    double to_side_deg = 180;  // off ahead, to both sides
    double reach_cm = 300;
};

// The wall that the nearest echo in the sector belongs to: it and its neighbours, as far as they
// are one surface. Nothing where there is no echo, or the nearest one is alone.
std::optional<Wall> nearest_wall(const std::vector<Echo>& echoes, const Sector& sector = {});

// The same direction, above -180 to 180.
double normal_angle(double degrees);

}  // namespace vagus::toolbox::carbot
