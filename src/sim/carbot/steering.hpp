// Two steered wheels on the middle line of a body: what they do to it, how they must turn for
// what is wanted of it. Plain geometry; docs/carbot.md has the picture in words.
#pragma once

namespace vagus::sim::carbot {

constexpr double kWheelAhead = 0.13;  // m from the middle of the body to each wheel

// Direction in radians counter-clockwise from ahead, speed along it in m/s (negative: backwards).
struct Wheel {
    double angle = 0;
    double speed = 0;
};

struct WheelPair {
    Wheel front;
    Wheel rear;
};

// How a body moves, in its own frame: m/s ahead and to the left, rad/s counter-clockwise.
struct Twist {
    double ahead = 0;
    double sideways = 0;
    double turn = 0;
};

// The motion that agrees best, by least squares, with what both wheels do.
Twist twist_of(const WheelPair& wheels);

// The wheels for a motion without a sideways part, angles from -90 to 90 degrees. In place both
// are at 90 degrees and roll against each other.
WheelPair wheels_for(double ahead, double turn);

}  // namespace vagus::sim::carbot
