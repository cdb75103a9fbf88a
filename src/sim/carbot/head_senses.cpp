#include "sim/carbot/head_senses.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"

namespace vagus::sim::carbot {
namespace {

constexpr double kFull = 1000;
constexpr double kTenths = 1800 / trig::kPi;  // tenths of a degree in a radian
constexpr double kDirectionNoise = 20;        // tenths of a degree
constexpr Colour kBorderColour = {0.9, 0.9, 0.9};
constexpr std::array<double, 1> kAhead = {0};

bool is_hidden(const Arena& arena, BodyId robot, const Pose& eye, double distance) {
    std::vector<Slice> slices;
    arena.slice(robot, eye, kAhead, slices);
    return std::any_of(slices.begin(), slices.end(), [distance](const Slice& slice) {
        return slice.leave <= distance && slice.height >= kInfraredEye;
    });
}

// Above -1800 and at most 1800.
int16_t tenths_of(double angle) {
    const int tenths = static_cast<int>(std::round(angle)) % 3600;
    return static_cast<int16_t>(tenths > 1800 ? tenths - 3600
                                              : (tenths <= -1800 ? tenths + 3600 : tenths));
}

}  // namespace

InfraredReading look_for_beacon(const Arena& arena, BodyId robot, std::span<const Point> beacons,
                                Noise& noise) {
    const Pose pose = arena.pose(robot);
    double nearest = kInfraredRange;
    double direction = 0;
    for (const Point& beacon : beacons) {
        const double x = beacon.x - pose.at.x;
        const double y = beacon.y - pose.at.y;
        const double distance = trig::hypot(x, y);
        if (distance >= nearest) continue;
        const double angle = trig::atan2(y, x);
        if (is_hidden(arena, robot, {pose.at, angle}, distance)) continue;
        nearest = distance;
        direction = angle - pose.angle;
    }
    if (nearest >= kInfraredRange) return {};
    const double intensity = std::round(kFull * (1 - nearest / kInfraredRange));
    return {tenths_of(direction * kTenths + kDirectionNoise * noise.next()),
            static_cast<int16_t>(std::max(1.0, intensity))};
}

ColourReading look_at_colour(const Arena& arena, BodyId robot, std::span<const Colour> colours) {
    const Pose pose = arena.pose(robot);
    const Pose eye = {{pose.at.x + trig::cos(pose.angle) * kColourPlace.x,
                       pose.at.y + trig::sin(pose.angle) * kColourPlace.x},
                      pose.angle};
    std::vector<Slice> slices;
    arena.slice(robot, eye, kAhead, slices);
    const auto seen = std::find_if(slices.begin(), slices.end(),
                                   [](const Slice& slice) { return slice.height >= kColourEye; });
    if (seen == slices.end() || seen->enter > kColourRange) return {};
    const bool known = seen->body.index < colours.size();
    const Colour colour = known ? colours[seen->body.index] : kBorderColour;
    const auto part = [](double value) { return static_cast<int16_t>(std::round(value * kFull)); };
    return {1, {part(colour.r), part(colour.g), part(colour.b)}};
}

}  // namespace vagus::sim::carbot
