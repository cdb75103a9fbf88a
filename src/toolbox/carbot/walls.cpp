#include "toolbox/carbot/walls.hpp"

#include <cmath>
#include <cstddef>

#include "base/trig.hpp"

namespace vagus::toolbox::carbot {

namespace {

constexpr double kDegree = trig::kPi / 180;
constexpr double kReach = 1.4;    // echoes up to so many times the nearest distance are looked at
constexpr double kStepMax = 0.3;  // from one echo of a surface to the next, as a part of it

struct Spot {
    double x;
    double y;
};

Spot spot_of(const Echo& echo) {
    return {echo.distance_cm * trig::cos(echo.angle_deg * kDegree),
            echo.distance_cm * trig::sin(echo.angle_deg * kDegree)};
}

// The line through the middle of the spots along their greatest spread (total least squares).
std::optional<Wall> line_through(const std::vector<Spot>& spots) {
    const auto count = static_cast<double>(spots.size());
    Spot middle{0, 0};
    for (const Spot& spot : spots) middle = {middle.x + spot.x / count, middle.y + spot.y / count};
    double xx = 0, xy = 0, yy = 0;
    for (const Spot& spot : spots) {
        const double x = spot.x - middle.x;
        const double y = spot.y - middle.y;
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    if (xx + yy < 1e-9) return std::nullopt;
    double direction = trig::atan2(2 * xy, xx - yy) / 2;  // -90 to 90 degrees
    if (direction <= -trig::kPi / 2) direction += trig::kPi;
    // Which side the line lies on, seen along it; the sign is that of a cross product.
    const double side = trig::cos(direction) * middle.y - trig::sin(direction) * middle.x;
    return Wall{std::abs(side), direction / kDegree, side > 0};
}

// The echo at `index` and its neighbours on the same surface.
std::vector<Spot> surface_around(const std::vector<Echo>& echoes, size_t index) {
    std::vector<Spot> spots = {spot_of(echoes[index])};
    const double reach = echoes[index].distance_cm * kReach;
    for (const int step : {-1, 1}) {
        double last = echoes[index].distance_cm;
        for (size_t i = index + static_cast<size_t>(step); i < echoes.size();
             i += static_cast<size_t>(step)) {  // below 0 wraps beyond the size
            const double distance = echoes[i].distance_cm;
            if (distance <= 0 || distance > reach) break;
            if (std::abs(distance - last) > kStepMax * last) break;
            spots.push_back(spot_of(echoes[i]));
            last = distance;
        }
    }
    return spots;
}

}  // namespace

std::optional<Wall> nearest_wall(const std::vector<Echo>& echoes) {
    std::optional<size_t> nearest;
    for (size_t i = 0; i < echoes.size(); ++i) {
        if (echoes[i].distance_cm <= 0) continue;
        if (!nearest || echoes[i].distance_cm < echoes[*nearest].distance_cm) nearest = i;
    }
    if (!nearest) return std::nullopt;
    const std::vector<Spot> spots = surface_around(echoes, *nearest);
    return spots.size() < 2 ? std::nullopt : line_through(spots);
}

std::optional<Wall> wall_through(const Echo& one, const Echo& other) {
    if (one.distance_cm <= 0 || other.distance_cm <= 0) return std::nullopt;
    return line_through({spot_of(one), spot_of(other)});
}

double normal_angle(double degrees) {
    const double turned = std::remainder(degrees, 360.0);
    return turned <= -180 ? turned + 360 : turned;
}

}  // namespace vagus::toolbox::carbot
