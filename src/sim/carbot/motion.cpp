#include "sim/carbot/motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"
#include "sim/arena.hpp"
#include "sim/carbot/chassis.hpp"

namespace vagus::sim::carbot {
namespace {

constexpr double kFaster = 0.8 * kArenaStep;  // m/s in a step, of a wheel
constexpr double kSlower = 0.6;               // m/s^2 of a wheel
constexpr double kCreep = 0.01;               // m/s: the slowest approach
constexpr double kRestSpeed = 0.001;          // m/s: a slower wheel is at rest
constexpr double kClose = 0.0003;             // m: so near is there
// Between what a servo does and shall do: within the first a path may be followed exactly, beyond
// the second the wheels do not roll.
constexpr double kAimed = 0.5 * trig::kPi / 180;
constexpr double kFarOff = 20 * trig::kPi / 180;

bool at_rest(const WheelPair& wheels) {
    return std::fabs(wheels.front.speed) < kRestSpeed && std::fabs(wheels.rear.speed) < kRestSpeed;
}

double way_of_servos(const WheelPair& from, const WheelPair& to) {
    return std::max(std::fabs(from.front.angle - to.front.angle),
                    std::fabs(from.rear.angle - to.rear.angle));
}

WheelPair scaled(WheelPair wheels, double factor) {
    wheels.front.speed *= factor;
    wheels.rear.speed *= factor;
    return wheels;
}

// Servos swing only under wheels at rest: under way they would drag the robot aside.
WheelPair swing(const WheelPair& wheels, const WheelPair& wanted) {
    return scaled(at_rest(wheels) ? wanted : wheels, 0);
}

// How fast the wheels roll in the direction that is wanted.
double speed_along(const WheelPair& wheels, const WheelPair& wanted) {
    return wanted.front.speed < 0 ? -wheels.front.speed : wheels.front.speed;
}

}  // namespace

// From metres or radians of the command to metres of a wheel: both roll the same way.
void Motion::start(MotionKind kind, const Order& order) {
    const WheelPair wheels = wheels_for(order.ahead, order.turn);
    const double scale = std::max(std::fabs(wheels.front.speed), 1e-9);
    kind_ = kind;
    state_ = MotionState::Drives;
    ending_ = halting_ = false;
    done_ = 0;  // a command takes the place of the one before, without a word of it
    path_ = {.aim = scaled(wheels, 1 / scale),
             .unit = {.ahead = order.ahead / scale, .sideways = 0, .turn = order.turn / scale},
             .left = order.left * scale,
             .speed_max = std::min(order.speed_max * scale, kSpeedMax),
             .scale = scale,
             .endless = order.endless};
}

void Motion::move(double distance, double speed) {
    start(MotionKind::Move, {.ahead = distance < 0 ? -1.0 : 1.0,
                             .turn = 0,
                             .left = std::fabs(distance),
                             .speed_max = speed});
}

void Motion::turn(double angle, double speed) {
    start(
        MotionKind::Turn,
        {.ahead = 0, .turn = angle < 0 ? -1.0 : 1.0, .left = std::fabs(angle), .speed_max = speed});
}

void Motion::curve(double radius, double angle, double speed) {
    start(MotionKind::Curve, {.ahead = speed < 0 ? -1.0 : 1.0,
                              .turn = (angle < 0 ? -1.0 : 1.0) / radius,
                              .left = radius * std::fabs(angle),
                              .speed_max = std::fabs(speed)});
}

void Motion::steer(double speed, double rate) {
    const double wheel = trig::hypot(speed, rate * kWheelAhead);
    start(MotionKind::Steer,
          {.ahead = speed, .turn = rate, .left = 0, .speed_max = 1, .endless = true});
    if (wheel == 0) path_.speed_max = 0;
}

void Motion::brake() {
    kind_ = MotionKind::None;
    state_ = MotionState::Brakes;
    halting_ = true;
    ending_ = false;
    done_ = 0;
    path_ = {};
}

void Motion::pause() {
    if (kind_ == MotionKind::None) return brake();
    state_ = MotionState::Paused;
    halting_ = true;
}

void Motion::resume() {
    if (state_ != MotionState::Paused) return;
    state_ = MotionState::Drives;
    halting_ = false;
}

bool Motion::cut() {
    if (kind_ == MotionKind::None) return false;
    brake();
    return true;
}

double Motion::left() const {
    return std::max(0.0, path_.left / path_.scale);
}

bool Motion::take(Ending what) {
    const auto bit = static_cast<uint8_t>(what);
    const bool happened = (done_ & bit) != 0;
    done_ = static_cast<uint8_t>(done_ & ~bit);
    return happened;
}

WheelPair Motion::step(const WheelPair& wheels) {
    count_way(wheels);
    switch (state_) {
        case MotionState::AtRest:
            return scaled(wheels, 0);
        case MotionState::Brakes:
        case MotionState::Paused:
            return halt(wheels);
        case MotionState::Drives:
            return path_.endless ? steady(wheels) : follow_path(wheels);
    }
    return scaled(wheels, 0);
}

// What the body does, as far as it lies along the path. What rolls out after a pause counts, too.
void Motion::count_way(const WheelPair& wheels) {
    if (kind_ == MotionKind::None || path_.endless) return;
    const Twist twist = twist_of(wheels);
    constexpr double kSquare = kWheelAhead * kWheelAhead;
    const double along = twist.ahead * path_.unit.ahead + twist.turn * path_.unit.turn * kSquare;
    path_.left -= along * kArenaStep;
}

WheelPair Motion::halt(const WheelPair& wheels) {
    speed_ = 0;
    if (halting_ && at_rest(wheels)) {
        halting_ = false;
        note(Ending::Halted);
        if (state_ == MotionState::Brakes) state_ = MotionState::AtRest;
    }
    return scaled(wheels, 0);
}

void Motion::finish() {
    note(kind_ == MotionKind::Turn ? Ending::Turned : Ending::Arrived);
    kind_ = MotionKind::None;
    state_ = MotionState::AtRest;
    path_ = {};
}

// The speed grows no quicker than the tyres like, and stays slow enough to stop in time, counting
// the way that the wheels roll on after they were told to stop.
WheelPair Motion::follow_path(const WheelPair& wheels) {
    const double rolling = speed_along(wheels, path_.aim);
    const double rest = path_.left - std::max(0.0, rolling) * kResponse;
    if (ending_ || rest <= kClose) {
        speed_ = 0;
        ending_ = true;
        if (at_rest(wheels)) finish();
        return scaled(wheels, 0);
    }
    if (way_of_servos(wheels, path_.aim) > kAimed) {
        speed_ = 0;
        return swing(wheels, path_.aim);
    }
    const double in_time = std::max(trig::sqrt(2 * kSlower * rest), kCreep);
    const double before = std::max(speed_, rolling);
    speed_ = std::min({before + kFaster, in_time, path_.speed_max});
    return scaled(path_.aim, speed_);
}

// Steer: less than the speed that is wanted while the servos are on their way, none when they are
// far off or the wheels roll the wrong way.
WheelPair Motion::steady(const WheelPair& wheels) {
    if (path_.speed_max == 0) {
        speed_ = 0;
        return scaled(wheels, 0);
    }
    const double off = way_of_servos(wheels, path_.aim);
    const bool wrong_way = speed_along(wheels, path_.aim) < 0 && !at_rest(wheels);
    if (off > kFarOff || wrong_way) {
        speed_ = 0;
        return swing(wheels, path_.aim);
    }
    speed_ = std::min(speed_ + kFaster, path_.speed_max);
    return scaled(path_.aim, speed_ * (1 - off / kFarOff));
}

}  // namespace vagus::sim::carbot
