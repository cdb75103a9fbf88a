// Two wheels on one axle, each turned by a motor that follows its target like a first-order system.
#pragma once

#include "sim/arena.hpp"

namespace vagus::sim {

struct WheelsDefinition {
    double base = 0.1;       // m between the wheels
    double response = 0.01;  // s: time constant of a motor
    double speed_max = 0.2;  // m/s of a wheel
};

class Wheels {
public:
    explicit Wheels(const WheelsDefinition& definition)
        : definition_(definition),
          // The exact answer of a first-order system to a step: 1 - exp(-t / response), by its
          // Padé approximation, which has the same bits everywhere: x (6 + x) / ((x + 4) x + 6)
          // … to 0.1 % for x up to 1.
          share_(share(kArenaStep / definition.response)) {}

    // One step of kArenaStep: targets in m/s.
    Drive step(double left, double right) {
        const double left_before = left_;
        const double right_before = right_;
        left_ += share_ * (limit(left) - left_);
        right_ += share_ * (limit(right) - right_);
        steady_ = left_ == left_before && right_ == right_before;
        return {.forward = (left_ + right_) / 2, .turn = (right_ - left_) / definition_.base};
    }
    // The last step changed nothing: with the same targets no other will.
    bool steady() const { return steady_; }
    double left() const { return left_; }
    double right() const { return right_; }

private:
    static double share(double x) { return x * (6 + x) / (x * (4 + x) + 6); }
    double limit(double speed) const {
        if (speed > definition_.speed_max) return definition_.speed_max;
        return speed < -definition_.speed_max ? -definition_.speed_max : speed;
    }

    WheelsDefinition definition_;
    double share_;
    double left_ = 0;
    double right_ = 0;
    bool steady_ = false;
};

}  // namespace vagus::sim
