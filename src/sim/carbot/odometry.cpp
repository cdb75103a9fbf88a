#include "sim/carbot/odometry.hpp"

#include <algorithm>

#include "base/trig.hpp"

namespace vagus::sim::carbot {

// With the heading of the middle of the step short chords make a true arc.
void Odometry::add(const Twist& twist, double seconds) {
    const double middle = pose_.angle + twist.turn * seconds / 2;
    const double c = trig::cos(middle);
    const double s = trig::sin(middle);
    const auto kept = [](double value) { return std::clamp(value, -kOdometryMax, kOdometryMax); };
    pose_.at.x = kept(pose_.at.x + seconds * (c * twist.ahead - s * twist.sideways));
    pose_.at.y = kept(pose_.at.y + seconds * (s * twist.ahead + c * twist.sideways));
    pose_.angle += twist.turn * seconds;
    if (pose_.angle > trig::kPi) pose_.angle -= 2 * trig::kPi;
    if (pose_.angle <= -trig::kPi) pose_.angle += 2 * trig::kPi;
}

}  // namespace vagus::sim::carbot
