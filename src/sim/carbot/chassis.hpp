// The servos and motors under a Carbot: they follow what they are told as fast as they can, count
// what they do, and slip a little on the ground.
#pragma once

#include "sim/carbot/steering.hpp"
#include "sim/noise.hpp"

namespace vagus::sim::carbot {

constexpr double kSpeedMax = 0.31;                 // m/s of a wheel
constexpr double kResponse = 0.03;                 // s: time constant of a motor
constexpr double kServoSpeed = 6.283185307179586;  // rad/s: 360 degrees

class Chassis {
public:
    // `seed` decides how this one slips.
    explicit Chassis(uint64_t seed);
    // From now on it slips otherwise; the flaws of its wheels stay as they were made.
    void reseed(uint64_t seed) { noise_.reseed(seed); }

    // One step of kArenaStep toward the targets. Gives the motion on the ground.
    Twist step(const WheelPair& targets);
    // The wheels as they count themselves: without slip.
    const WheelPair& counted() const { return counted_; }

private:
    struct Flaw {
        double scale = 1;   // m on the ground for each m counted
        double offset = 0;  // rad between the servo's angle and the wheel's
    };
    Flaw make_flaw();
    Wheel on_ground(const Wheel& wheel, const Flaw& flaw);

    Noise noise_;
    Flaw front_;
    Flaw rear_;
    WheelPair counted_;
};

}  // namespace vagus::sim::carbot
