// The body of a Thymio II: hull, wheels, sensors. Every number here is in docs/sensors.md with
// its source. Knows the arena and the ground; nothing of variables and nodes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/arena.hpp"
#include "sim/drawing.hpp"
#include "sim/ground.hpp"
#include "sim/noise.hpp"
#include "sim/wheels.hpp"

namespace vagus::sim::thymio2 {

constexpr size_t kHorizontalCount = 7;  // five ahead from left to right, two behind: left, right
constexpr size_t kGroundCount = 2;      // left, right
constexpr double kSpeedUnit = 0.166 / 500;  // m/s: 500 is 16.6 cm/s (docs/spec, 5.2)
constexpr double kRange = 0.14;             // m

std::span<const Point> outline();

// The reading of a horizontal sensor whose middle ray is free for `distance` metres, without noise.
double horizontal_reading(double distance);
// The reading of a ground sensor over a ground of that brightness (0 to 1), without noise.
double ground_reading(double brightness);

struct Horizontal {
    std::array<int16_t, kHorizontalCount> values{};
};
struct GroundReadings {
    std::array<int16_t, kGroundCount> ambient{};
    std::array<int16_t, kGroundCount> reflected{};
};

class Body {
public:
    Body(Arena& arena, const Pose& pose);

    BodyId id() const { return id_; }
    // Targets as in motor.*.target; call once before each step of the arena. False if the wheels
    // have reached the speed at which these targets keep them.
    bool drive(Arena& arena, int16_t left, int16_t right);
    // Speeds of the wheels, in the unit of motor.*.target.
    int16_t left_speed() const;
    int16_t right_speed() const;

    // The middle rays as they end now, for drawing.
    std::vector<Beam> beams(const Arena& arena) const;
    Horizontal look(const Arena& arena, Noise& noise) const;
    GroundReadings look_down(const Pose& pose, const Ground& ground, Noise& noise) const;

private:
    BodyId id_;
    Wheels wheels_;
};

}  // namespace vagus::sim::thymio2
