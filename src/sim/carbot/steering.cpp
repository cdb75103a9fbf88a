#include "sim/carbot/steering.hpp"

#include "base/trig.hpp"

namespace vagus::sim::carbot {
namespace {

// Below this speed ahead a turn counts as one in place, m/s per m/s at the wheel.
constexpr double kInPlace = 1e-6;

// The wheel that moves by that vector, rolling backwards rather than looking backwards.
Wheel wheel_along(double x, double y) {
    const double sign = x < 0 ? -1 : 1;
    return {.angle = trig::atan2(sign * y, sign * x), .speed = sign * trig::hypot(x, y)};
}

}  // namespace

Twist twist_of(const WheelPair& wheels) {
    const auto& [front, rear] = wheels;
    const double front_side = front.speed * trig::sin(front.angle);
    const double rear_side = rear.speed * trig::sin(rear.angle);
    return {
        .ahead = (front.speed * trig::cos(front.angle) + rear.speed * trig::cos(rear.angle)) / 2,
        .sideways = (front_side + rear_side) / 2,
        .turn = (front_side - rear_side) / (2 * kWheelAhead)};
}

WheelPair wheels_for(double ahead, double turn) {
    const double side = turn * kWheelAhead;
    const double size = ahead < 0 ? -ahead : ahead;
    const double side_size = side < 0 ? -side : side;
    if (size <= kInPlace * side_size)
        return {.front = {trig::kPi / 2, side}, .rear = {trig::kPi / 2, -side}};
    return {.front = wheel_along(ahead, side), .rear = wheel_along(ahead, -side)};
}

}  // namespace vagus::sim::carbot
