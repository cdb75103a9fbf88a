#include "sim/carbot/chassis.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"
#include "sim/arena.hpp"

namespace vagus::sim::carbot {
namespace {

// Standard deviations (docs/carbot.md).
constexpr double kScaleFlaw = 0.001;
constexpr double kAngleFlaw = 0.03 * trig::kPi / 180;
constexpr double kSlip = 0.005;    // of the speed, again in every step
constexpr double kSticks = 0.001;  // m/s: friction holds a slower wheel that is to be at rest

// 1 - exp(-step / response) by its Padé approximation, which has the same bits everywhere
// (sim/wheels.hpp).
constexpr double share(double x) {
    return x * (6 + x) / (x * (4 + x) + 6);
}

void follow(Wheel& wheel, const Wheel& target) {
    constexpr double kTurnMax = kServoSpeed * kArenaStep;
    constexpr double kShare = share(kArenaStep / kResponse);
    const double angle = std::clamp(target.angle, -trig::kPi / 2, trig::kPi / 2);
    wheel.angle += std::clamp(angle - wheel.angle, -kTurnMax, kTurnMax);
    wheel.speed += kShare * (std::clamp(target.speed, -kSpeedMax, kSpeedMax) - wheel.speed);
    if (target.speed == 0 && std::fabs(wheel.speed) < kSticks) wheel.speed = 0;
}

}  // namespace

Chassis::Chassis(uint64_t seed) : noise_(seed), front_(make_flaw()), rear_(make_flaw()) {}

Chassis::Flaw Chassis::make_flaw() {
    const double scale = 1 + kScaleFlaw * noise_.next();
    return {.scale = scale, .offset = kAngleFlaw * noise_.next()};
}

Wheel Chassis::on_ground(const Wheel& wheel, const Flaw& flaw) {
    const double slip = kSlip * noise_.next();
    return {.angle = wheel.angle + flaw.offset, .speed = wheel.speed * (flaw.scale + slip)};
}

Twist Chassis::step(const WheelPair& targets) {
    follow(counted_.front, targets.front);
    follow(counted_.rear, targets.rear);
    const Wheel front = on_ground(counted_.front, front_);
    const Wheel rear = on_ground(counted_.rear, rear_);
    return twist_of({front, rear});
}

}  // namespace vagus::sim::carbot
