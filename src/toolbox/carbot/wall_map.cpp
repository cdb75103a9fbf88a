#include "toolbox/carbot/wall_map.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"

namespace vagus::toolbox::carbot {

namespace {

constexpr double kLeftSlope = 0.577;  // 30 degrees from ahead the left begins

double direction_of(const Spot& spot) {
    return trig::atan2(spot.y_cm, spot.x_cm) * 180 / trig::kPi;
}

// The spot as the sensor sees it.
Spot from_sensor(const Pose& robot, const Spot& spot) {
    const Spot seen = seen_from(robot, spot);
    return {seen.x_cm - kSensorAheadCm, seen.y_cm};
}

}  // namespace

void WallMap::take(const std::vector<Sounding>& sweep) {
    if (sweep.empty()) return;
    const Pose& here = sweep.back().from;
    driven_cm_ += trig::hypot(here.x_cm - last_.x_cm, here.y_cm - last_.y_cm);
    last_ = here;
    forget(sweep);
    for (const Spot& spot : spots_of(sweep)) {
        const Spot seen = from_sensor(here, spot);
        if (trig::hypot(seen.x_cm, seen.y_cm) > kMapReachCm) continue;
        spots_.push_back({spot, driven_cm_});
    }
    if (spots_.size() > kMapSpotsMax) {
        spots_.erase(spots_.begin(), spots_.end() - kMapSpotsMax);
    }
}

// What is in sight is seen again; what is far away or long ago does not matter any more.
void WallMap::forget(const std::vector<Sounding>& sweep) {
    const double one = sweep.front().echo.angle_deg;
    const double other = sweep.back().echo.angle_deg;
    std::erase_if(spots_, [&](const Kept& kept) {
        if (driven_cm_ - kept.seen_at_cm > remembered_cm_) return true;
        const Spot seen = from_sensor(last_, kept.spot);
        const double direction = direction_of(seen);
        return trig::hypot(seen.x_cm, seen.y_cm) > kMapReachCm ||
               (direction >= std::min(one, other) && direction <= std::max(one, other));
    });
}

Sides WallMap::distances_from(const Pose& pose) const {
    const double c = cosine(pose.heading_deg);
    const double s = sine(pose.heading_deg);
    double right = kMapReachCm * kMapReachCm;
    double left = right;
    for (const Kept& kept : spots_) {
        const double x = kept.spot.x_cm - pose.x_cm;
        const double y = kept.spot.y_cm - pose.y_cm;
        const double ahead = c * x + s * y;
        const double beside = c * y - s * x;
        double& nearest = beside > kLeftSlope * std::max(ahead, 0.0) ? left : right;
        nearest = std::min(nearest, x * x + y * y);
    }
    return {std::sqrt(right), std::sqrt(left)};
}

}  // namespace vagus::toolbox::carbot
