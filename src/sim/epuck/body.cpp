#include "sim/epuck/body.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"
#include "sim/fan.hpp"

namespace vagus::sim::epuck {
namespace {

constexpr double kRadius = 0.037;  // m
constexpr double kEyeHeight = 0.02;
constexpr double kNoise = 10;  // of a distance sensor
constexpr RobotBody kBody = {.mass = 0.2, .inertia = 1.4e-4, .grip = 0.0265, .height = 0.05};
constexpr WheelsDefinition kWheels = {.base = 0.053, .response = 0.01, .speed_max = 0.13};

// 17, 47, 90 and 147 degrees from straight ahead.
constexpr Direction k17 = {0.95630475596303544, 0.29237170472273677};
constexpr Direction k47 = {0.68199836006249848, 0.73135370161917046};
constexpr Direction k90 = {0, 1};
constexpr Direction k147 = {-0.83867056794542405, 0.54463903501502708};

constexpr SensorPlace on_rim(Direction way) {
    return {{kRadius * way.cosine, kRadius * way.sine}, way};
}
constexpr std::array<SensorPlace, kProxCount> kPlaces = {
    on_rim(mirrored(k17)), on_rim(mirrored(k47)), on_rim(mirrored(k90)), on_rim(mirrored(k147)),
    on_rim(k147),          on_rim(k90),           on_rim(k47),           on_rim(k17)};
constexpr auto kRays = rays_of(kPlaces, kRange);

// Readings at distances in centimetres, straight lines between them.
struct Entry {
    double distance;
    double reading;
};
constexpr Entry kTable[] = {{0, 3910},  {0.1, 3726}, {0.5, 2985}, {0.9, 1848}, {1.3, 1125},
                            {1.7, 726}, {2.1, 493},  {2.5, 361},  {2.9, 268},  {3.3, 212},
                            {3.7, 169}, {4.1, 134},  {4.5, 110},  {5.3, 78},   {6.1, 60},
                            {7.3, 43},  {8.5, 31},   {10, 22},    {12, 14}};

// One pixel a degree, the middle between the two innermost ones.
std::array<double, kCameraCount> camera_tangents() {
    std::array<double, kCameraCount> tangents;
    for (size_t i = 0; i < kCameraCount; ++i) {
        const double degrees = static_cast<double>(i) - (kCameraCount - 1) / 2.0;
        tangents[i] = trig::tan(degrees * trig::kPi / 180);
    }
    return tangents;
}

const RayFan& fan_of_all() {
    static const RayFan kFan(kRays);
    return kFan;
}

// The corners of a circle, for drawing only.
std::array<Point, 16> make_outline() {
    std::array<Point, 16> corners;
    for (size_t i = 0; i < corners.size(); ++i) {
        const double angle = 2 * trig::kPi * static_cast<double>(i) / corners.size();
        corners[i] = {kRadius * trig::cos(angle), kRadius * trig::sin(angle)};
    }
    return corners;
}

}  // namespace

std::span<const Point> outline() {
    static const std::array<Point, 16> kOutline = make_outline();
    return kOutline;
}

double prox_reading(double distance) {
    if (distance >= kRange) return 0;
    const double at = std::max(0.0, distance * 100);
    const Entry* const next =
        std::find_if(std::begin(kTable) + 1, std::end(kTable) - 1,
                     [at](const Entry& entry) { return entry.distance >= at; });
    const Entry& low = next[-1];
    const double part = (at - low.distance) / (next->distance - low.distance);
    return low.reading + part * (next->reading - low.reading);
}

Body::Body(Arena& arena, const Pose& pose)
    : id_(arena.add_robot({.corners = {}, .radius = kRadius}, pose, kBody)), wheels_(kWheels) {}

bool Body::drive(Arena& arena, int16_t left, int16_t right) {
    arena.drive(id_, wheels_.step(left * kSpeedUnit, right * kSpeedUnit));
    return !wheels_.steady();
}

// Unlike on a Thymio there is noise also where nothing is seen, cut off at 0.
std::array<int16_t, kProxCount> Body::look(const Arena& arena, Noise& noise) const {
    std::array<double, kRays.size()> distances;
    arena.look(id_, fan_of_all(), kEyeHeight, distances);
    std::array<int16_t, kProxCount> seen;
    for (size_t i = 0; i < kProxCount; ++i) {
        const double* const fan = &distances[i * kRaysPerSensor];
        const double side = kSideWeight * prox_reading(std::min(fan[1], fan[2]));
        const double reading = std::max(prox_reading(fan[0]), side) + kNoise * noise.next();
        seen[i] = static_cast<int16_t>(std::floor(std::clamp(reading, 0.0, 4095.0) + 0.5));
    }
    return seen;
}

std::vector<Beam> Body::beams(const Arena& arena) const {
    std::array<double, kRays.size()> distances;
    arena.look(id_, fan_of_all(), kEyeHeight, distances);
    return middle_beams(kRays, distances, arena.pose(id_));
}

std::array<Column, kCameraCount> Body::look_ahead(const Arena& arena) const {
    static const std::array<double, kCameraCount> kTangents = camera_tangents();
    std::array<Column, kCameraCount> columns;
    arena.look_wide(id_, kRadius, kTangents, columns);
    return columns;
}

}  // namespace vagus::sim::epuck
