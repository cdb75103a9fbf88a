// Where a robot believes to be, by counting its wheels.
#pragma once

#include "sim/carbot/steering.hpp"
#include "sim/definitions.hpp"

namespace vagus::sim::carbot {

constexpr double kOdometryMax = 10000;  // m, either sign: what lies beyond is told as this

class Odometry {
public:
    // The body has moved so for `seconds`.
    void add(const Twist& twist, double seconds);
    void set(const Pose& pose) { pose_ = pose; }
    // The angle is above -pi and at most pi.
    const Pose& pose() const { return pose_; }

private:
    Pose pose_;
};

}  // namespace vagus::sim::carbot
