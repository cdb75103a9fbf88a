// What the head of a Carbot perceives: where the strongest infrared beacon is, and the colour of
// what is right before it. Numbers as its node counts them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sim/arena.hpp"
#include "sim/noise.hpp"

namespace vagus::sim::carbot {

constexpr double kInfraredRange = 4.0;  // m
constexpr double kInfraredEye = 0.10;   // m above the ground: lower things hide no beacon
constexpr double kColourRange = 0.17;   // m: 15 cm before the hull
constexpr double kColourEye = 0.03;     // m above the ground
constexpr Point kColourPlace = {
    0.18, 0};  // in the frame of the robot: even what touches the hull is seen

struct InfraredReading {
    int16_t direction = 0;  // tenths of a degree from ahead
    int16_t intensity = 0;  // 1000 at the beacon, falling evenly to 0 at kInfraredRange; 0: none
    bool operator==(const InfraredReading&) const = default;
};

// From the middle of the robot, the nearest of the beacons that nothing hides, 2 degrees of noise
// on its direction. A body hides what lies wholly behind it; a beacon inside a body shines through.
InfraredReading look_for_beacon(const Arena& arena, BodyId robot, std::span<const Point> beacons,
                                Noise& noise);

struct ColourReading {
    int16_t near = 0;              // 1: something is there
    std::array<int16_t, 3> rgb{};  // 0 to 1000
    bool operator==(const ColourReading&) const = default;
};

// Straight ahead. `colours` are those of bodies by index.
ColourReading look_at_colour(const Arena& arena, BodyId robot, std::span<const Colour> colours);

}  // namespace vagus::sim::carbot
