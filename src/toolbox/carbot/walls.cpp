#include "toolbox/carbot/walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/trig.hpp"

namespace vagus::toolbox::carbot {

namespace {

// Echoes up to so many times the nearest distance are looked at: in a corner, farther ones come
// before those of the other wall.
constexpr double kReach = 1.15;
constexpr double kNoise = 0.04;   // a wall gets no nearer to the side of its nearest point
constexpr double kStepMax = 0.3;  // from one echo of a surface to the next, as a part of it
constexpr double kFitStep = 0.5;  // directions that are tried, in degrees

double cosine(double degrees) {
    return trig::cos(degrees * trig::kPi / 180);
}

// How far a wall with that normal would be, by this echo.
double distance_by(const Echo& echo, double normal_deg) {
    const double off = std::abs(normal_angle(echo.angle_deg - normal_deg)) - kConeDeg;
    return echo.distance_cm * cosine(std::clamp(off, 0.0, kGrazeDeg));
}

struct Fit {
    double distance_cm;
    double spread;  // of what the echoes say about it: mean square, as a part of its square
};

Fit fit_at(const std::vector<Echo>& echoes, double normal_deg) {
    const auto count = static_cast<double>(echoes.size());
    double mean = 0;
    for (const Echo& echo : echoes) mean += distance_by(echo, normal_deg) / count;
    double spread = 0;
    for (const Echo& echo : echoes) {
        const double off = distance_by(echo, normal_deg) / mean - 1;
        spread += off * off / count;
    }
    return {mean, spread};
}

bool is_in(const Sector& sector, const Echo& echo) {
    return echo.distance_cm > 0 && echo.distance_cm <= sector.reach_cm &&
           std::abs(echo.angle_deg) <= sector.to_side_deg;
}

// The echo at `index` and its neighbours on the same surface.
std::vector<Echo> surface_around(const std::vector<Echo>& echoes, size_t index) {
    std::vector<Echo> surface = {echoes[index]};
    const double reach = echoes[index].distance_cm * kReach;
    for (const int step : {-1, 1}) {
        double last = echoes[index].distance_cm;
        for (size_t i = index + static_cast<size_t>(step); i < echoes.size();
             i += static_cast<size_t>(step)) {  // below 0 wraps beyond the size
            const double distance = echoes[i].distance_cm;
            if (distance <= 0 || distance > reach) break;
            if (std::abs(distance - last) > kStepMax * last) break;
            if (distance < last * (1 - kNoise)) break;  // beyond a corner it is the next wall's
            surface.push_back(echoes[i]);
            last = distance;
        }
    }
    return surface;
}

}  // namespace

double Wall::turn_to_have_it_right() const {
    return normal_angle(normal_deg + 90);
}

double Wall::turn_to_have_it_left() const {
    return normal_angle(normal_deg - 90);
}

std::optional<Wall> fit_wall(const std::vector<Echo>& all) {
    std::vector<Echo> echoes;
    std::copy_if(all.begin(), all.end(), std::back_inserter(echoes),
                 [](const Echo& echo) { return echo.distance_cm > 0; });
    if (echoes.size() < 2) return std::nullopt;
    const auto [low, high] =
        std::minmax_element(echoes.begin(), echoes.end(),
                            [](const Echo& a, const Echo& b) { return a.angle_deg < b.angle_deg; });
    const double from = low->angle_deg - kGrazeDeg;
    const auto steps = static_cast<int>((high->angle_deg + kGrazeDeg - from) / kFitStep);
    std::optional<Fit> best;
    double first = from;  // of the directions that fit equally well, in the middle of the cone
    double last = from;
    for (int i = 0; i <= steps; ++i) {
        const double normal = from + i * kFitStep;
        const Fit fit = fit_at(echoes, normal);
        if (best && fit.spread > best->spread) continue;
        if (!best || fit.spread < best->spread) first = normal;
        last = normal;
        best = fit;
    }
    return Wall{best->distance_cm, normal_angle((first + last) / 2)};
}

std::optional<Wall> nearest_wall(const std::vector<Echo>& echoes, const Sector& sector) {
    std::optional<size_t> nearest;
    for (size_t i = 0; i < echoes.size(); ++i) {
        if (!is_in(sector, echoes[i])) continue;
        if (!nearest || echoes[i].distance_cm < echoes[*nearest].distance_cm) nearest = i;
    }
    return nearest ? fit_wall(surface_around(echoes, *nearest)) : std::nullopt;
}

double normal_angle(double degrees) {
    const double turned = std::remainder(degrees, 360.0);
    return turned <= -180 ? turned + 360 : turned;
}

}  // namespace vagus::toolbox::carbot
