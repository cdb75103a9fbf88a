#include "toolbox/carbot/spots.hpp"

#include <cmath>
#include <cstddef>

#include "base/trig.hpp"
#include "toolbox/carbot/walls.hpp"

namespace vagus::toolbox::carbot {

namespace {

constexpr double kSame = 0.04;  // of the distance: the same surface at the same place
constexpr double kEdge = 0.3;   // of the distance: beyond, what is nearer is something else

double distance_at(const std::vector<Sounding>& sweep, size_t index) {
    return index < sweep.size() ? sweep[index].echo.distance_cm : 0;
}

// The neighbour is a part of the same surface, nearer.
bool is_nearer(double neighbour, double distance) {
    return neighbour > 0 && neighbour < distance * (1 - kSame) &&
           neighbour > distance * (1 - kEdge);
}

// One past the last of those from `first` on that tell of the same spot.
size_t end_of_row(const std::vector<Sounding>& sweep, size_t first) {
    const double distance = distance_at(sweep, first);
    size_t end = first + 1;
    while (end < sweep.size() && std::abs(distance_at(sweep, end) - distance) <= kSame * distance) {
        ++end;
    }
    return end;
}

// The sounding with its direction turned towards the neighbour.
Sounding turned_towards(Sounding sounding, const Sounding& neighbour) {
    const double way = neighbour.echo.angle_deg - sounding.echo.angle_deg;
    sounding.echo.angle_deg += way < 0 ? -kConeDeg : kConeDeg;
    return sounding;
}

}  // namespace

Spot spot_of(const Pose& robot, const Echo& echo) {
    return placed(robot, {kSensorAheadCm + echo.distance_cm * cosine(echo.angle_deg),
                          echo.distance_cm * sine(echo.angle_deg)});
}

std::vector<Spot> spots_of(const std::vector<Sounding>& sweep) {
    std::vector<Spot> spots;
    const auto add = [&spots](const Sounding& one) {
        spots.push_back(spot_of(one.from, one.echo));
    };
    for (size_t first = 0, end = 0; first < sweep.size(); first = end) {
        end = end_of_row(sweep, first);
        const double distance = distance_at(sweep, first);
        if (distance <= 0) continue;
        // Before the first, the index wraps beyond the size.
        const bool before = is_nearer(distance_at(sweep, first - 1), distance);
        const bool behind = is_nearer(distance_at(sweep, end), distance);
        if (before && behind) continue;
        if (!before && !behind) add(sweep[(first + end - 1) / 2]);
        for (size_t i = first; i < end && before != behind; ++i) {
            add(turned_towards(sweep[i], sweep[before ? first - 1 : end]));
        }
    }
    return spots;
}

Spot seen_from(const Pose& robot, const Spot& spot) {
    const double x = spot.x_cm - robot.x_cm;
    const double y = spot.y_cm - robot.y_cm;
    const double c = cosine(robot.heading_deg);
    const double s = sine(robot.heading_deg);
    return {c * x + s * y, c * y - s * x};
}

Spot placed(const Pose& robot, const Spot& spot) {
    const double c = cosine(robot.heading_deg);
    const double s = sine(robot.heading_deg);
    return {robot.x_cm + c * spot.x_cm - s * spot.y_cm, robot.y_cm + s * spot.x_cm + c * spot.y_cm};
}

double sine(double degrees) {
    return trig::sin(degrees * trig::kDegree);
}

double cosine(double degrees) {
    return trig::cos(degrees * trig::kDegree);
}

}  // namespace vagus::toolbox::carbot
