// The rays of wide-beamed distance sensors: three for each, its direction and 15 degrees to both
// sides of it.
#pragma once

#include <array>
#include <vector>

#include "sim/arena.hpp"
#include "sim/drawing.hpp"

namespace vagus::sim {

constexpr size_t kRaysPerSensor = 3;
// Of what a side ray reads, beside the middle one. Below the ratio at which a wall seen at a slant
// would read more than it does in docs/sensors.md.
constexpr double kSideWeight = 0.8;

// A direction by its cosine and sine.
struct Direction {
    double cosine = 1;
    double sine = 0;
};

constexpr Direction turned(Direction a, Direction by) {
    return {a.cosine * by.cosine - a.sine * by.sine, a.sine * by.cosine + a.cosine * by.sine};
}
constexpr Direction mirrored(Direction a) {
    return {a.cosine, -a.sine};
}

struct SensorPlace {
    Point at;
    Direction direction;
};

// The middle ray of each sensor first, then its left and right one.
template <size_t kCount>
constexpr std::array<Ray, kCount * kRaysPerSensor> rays_of(
    const std::array<SensorPlace, kCount>& places, double range) {
    constexpr Direction k15 = {0.96592582628906831, 0.25881904510252074};
    std::array<Ray, kCount * kRaysPerSensor> rays{};
    size_t next = 0;
    for (const auto& [at, middle] : places) {
        for (const Direction& way : {middle, turned(middle, k15), turned(middle, mirrored(k15))})
            rays[next++] = {at, {way.cosine, way.sine}, range};
    }
    return rays;
}

// The middle rays in the world, given how far all rays get.
std::vector<Beam> middle_beams(std::span<const Ray> rays, std::span<const double> distances,
                               const Pose& pose);

}  // namespace vagus::sim
