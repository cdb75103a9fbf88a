#include "sim/thymio2/body.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"
#include "sim/fan.hpp"

namespace vagus::sim::thymio2 {
namespace {

// Measured on asebaplayground and fitted by tools/measure_playground_fit.py: docs/sensors.md.
constexpr double kReadingMax = 4510;
constexpr double kReadingWidth = 0.0854;  // m: at this distance half of the largest reading
constexpr double kHorizontalNoise = 2.7;
constexpr double kGroundNoise = 10;
constexpr double kEyeHeight = 0.03;  // m
constexpr double kAmbientMax = 1023;

constexpr RobotBody kBody = {.mass = 0.27, .inertia = 5.5e-4, .grip = 0.0475, .height = 0.053};
constexpr WheelsDefinition kWheels = {.base = 0.095, .response = 0.01, .speed_max = 0.2};

constexpr std::array<Point, 8> kOutline = {{{-0.030, -0.056},
                                            {0.045, -0.056},
                                            {0.063, -0.050},
                                            {0.080, -0.016},
                                            {0.080, 0.016},
                                            {0.063, 0.050},
                                            {0.045, 0.056},
                                            {-0.030, 0.056}}};

// 40, 20, 0, -20, -40 degrees ahead, and straight behind.
constexpr Direction k0 = {1, 0};
constexpr Direction k20 = {0.93969262078590843, 0.34202014332566871};
constexpr Direction k40 = {0.76604444311897801, 0.64278760968653925};
constexpr Direction k180 = {-1, 0};
constexpr std::array<SensorPlace, kHorizontalCount> kPlaces = {{{{0.0588, 0.0512}, k40},
                                                                {{0.0742, 0.0256}, k20},
                                                                {{0.0795, 0}, k0},
                                                                {{0.0742, -0.0256}, mirrored(k20)},
                                                                {{0.0588, -0.0512}, mirrored(k40)},
                                                                {{-0.0297, 0.0271}, k180},
                                                                {{-0.0297, -0.0271}, k180}}};
constexpr auto kRays = rays_of(kPlaces, kRange);

constexpr std::array<Point, kGroundCount> kGroundPlaces = {{{0.072, 0.012}, {0.072, -0.012}}};

// Readings over grounds of brightness 0, 0.1 … 1.
constexpr std::array<double, 11> kGroundTable = {75,  98,  150, 253, 423, 617,
                                                 773, 865, 909, 929, 938};

int16_t rounded(double value) {
    return static_cast<int16_t>(std::floor(value + 0.5));
}

}  // namespace

std::span<const Point> outline() {
    return kOutline;
}

double horizontal_reading(double distance) {
    if (distance >= kRange) return 0;
    constexpr double kSquare = kReadingWidth * kReadingWidth;
    return kReadingMax * kSquare / (kSquare + distance * distance);
}

double ground_reading(double brightness) {
    const double place = std::clamp(brightness, 0.0, 1.0) * 10;
    const auto k = std::min<size_t>(static_cast<size_t>(place), 9);
    return kGroundTable[k] +
           (place - static_cast<double>(k)) * (kGroundTable[k + 1] - kGroundTable[k]);
}

Body::Body(Arena& arena, const Pose& pose)
    : id_(arena.add_robot({.corners = kOutline, .radius = 0}, pose, kBody)), wheels_(kWheels) {}

bool Body::drive(Arena& arena, int16_t left, int16_t right) {
    arena.drive(id_, wheels_.step(left * kSpeedUnit, right * kSpeedUnit));
    return !wheels_.steady();
}

int16_t Body::left_speed() const {
    return rounded(wheels_.left() / kSpeedUnit);
}

int16_t Body::right_speed() const {
    return rounded(wheels_.right() / kSpeedUnit);
}

namespace {

const RayFan& fan_of_all() {
    static const RayFan kFan(kRays);
    return kFan;
}

}  // namespace

std::vector<Beam> Body::beams(const Arena& arena) const {
    std::array<double, kRays.size()> distances;
    arena.look(id_, fan_of_all(), kEyeHeight, distances);
    return middle_beams(kRays, distances, arena.pose(id_));
}

Horizontal Body::look(const Arena& arena, Noise& noise) const {
    std::array<double, kRays.size()> distances;
    arena.look(id_, fan_of_all(), kEyeHeight, distances);
    Horizontal seen;
    for (size_t i = 0; i < kHorizontalCount; ++i) {
        const double* const fan = &distances[i * kRaysPerSensor];
        const double side = std::min(fan[1], fan[2]);
        const double reading =
            std::max(horizontal_reading(fan[0]), kSideWeight * horizontal_reading(side));
        if (reading > 0) seen.values[i] = rounded(reading + kHorizontalNoise * noise.next());
    }
    return seen;
}

GroundReadings Body::look_down(const Pose& pose, const Ground& ground, Noise& noise) const {
    const auto [sine, cosine] = trig::sin_cos(pose.angle);
    GroundReadings seen;
    for (size_t i = 0; i < kGroundCount; ++i) {
        const Point& place = kGroundPlaces[i];
        const Point at = {pose.at.x + cosine * place.x - sine * place.y,
                          pose.at.y + sine * place.x + cosine * place.y};
        const double reading =
            ground_reading(brightness(ground.colour_at(at))) + kGroundNoise * noise.next();
        seen.reflected[i] = rounded(std::clamp(reading, 0.0, 1023.0));
        seen.ambient[i] = rounded(kAmbientMax * ground.light_at(at));
    }
    return seen;
}

}  // namespace vagus::sim::thymio2
