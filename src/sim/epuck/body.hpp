// The body of an e-puck: hull, wheels, distance sensors, camera. Every number here is from
// docs/sensors.md with its source.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/arena.hpp"
#include "sim/drawing.hpp"
#include "sim/noise.hpp"
#include "sim/wheels.hpp"

namespace vagus::sim::epuck {

constexpr size_t kProxCount = 8;             // from ahead right clockwise around to ahead left
constexpr size_t kCameraCount = 60;          // pixels, the first one rightmost
constexpr double kSpeedUnit = 0.128 / 1000;  // m/s (docs/spec, 5.3)
constexpr double kRange = 0.12;              // m

std::span<const Point> outline();

// The reading of a sensor whose middle ray is free for `distance` metres, without noise.
double prox_reading(double distance);

class Body {
public:
    Body(Arena& arena, const Pose& pose);

    BodyId id() const { return id_; }
    bool drive(Arena& arena, int16_t left, int16_t right);
    std::array<int16_t, kProxCount> look(const Arena& arena, Noise& noise) const;
    std::vector<Beam> beams(const Arena& arena) const;
    // The body that each pixel sees.
    std::array<Column, kCameraCount> look_ahead(const Arena& arena) const;

private:
    BodyId id_;
    Wheels wheels_;
};

}  // namespace vagus::sim::epuck
