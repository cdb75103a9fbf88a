#include "toolbox/carbot/wall_steering.hpp"

#include <algorithm>
#include <cmath>

namespace vagus::toolbox::carbot {

namespace {

constexpr double kRateMaxDeg = 60;  // a second
constexpr double kRateStepDeg = 10;
constexpr double kSlowing = 0.5;    // of the speed, in the sharpest curve
constexpr double kSharpCost = 2;    // cm^2, of the sharpest curve
constexpr int kStepsAhead = 8;      // so far it thinks ahead, each …
constexpr double kStepTime = 0.25;  // … of so many seconds

// The mean square of how far the distance will be off, cm^2; at the left, of how much too near.
double error_of(const WallMap& map, Pose pose, const Steering& steering, double distance_cm) {
    double sum = 0;
    for (int i = 0; i < kStepsAhead; ++i) {
        pose.heading_deg += steering.rate_deg * kStepTime;
        pose.x_cm += steering.speed_cm * kStepTime * cosine(pose.heading_deg);
        pose.y_cm += steering.speed_cm * kStepTime * sine(pose.heading_deg);
        const Sides sides = map.distances_from(pose);
        const double right = sides.right_cm - kHalfWidthCm - distance_cm;
        const double left = std::min(sides.left_cm - kHalfWidthCm - distance_cm, 0.0);
        sum += right * right + left * left;
    }
    return sum / kStepsAhead;
}

}  // namespace

Steering steer_along(const WallMap& map, const Pose& from, const AlongWall& goal) {
    Steering best;
    double lowest = HUGE_VAL;
    for (double rate = -kRateMaxDeg; rate <= kRateMaxDeg; rate += kRateStepDeg) {
        const double sharp = std::abs(rate) / kRateMaxDeg;
        const Steering steering{goal.speed_cm * (1 - kSlowing * sharp), rate};
        const double error = error_of(map, from, steering, goal.distance_cm);
        const double cost = goal.gain * error + kSharpCost * sharp * sharp;
        if (cost >= lowest) continue;
        lowest = cost;
        best = steering;
    }
    return best;
}

}  // namespace vagus::toolbox::carbot
