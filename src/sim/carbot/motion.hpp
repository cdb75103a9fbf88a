// The driving commands of a Carbot: what its drive node's firmware makes of "one metre ahead".
// Told in each step how the wheels are, it says where they shall go. Knows nothing of nodes and
// ground.
//
//     Motion motion;
//     motion.move(1.0, 0.2);                                   // m, m/s
//     for (;;) { chassis.step(motion.step(chassis.counted())); }
//     if (motion.take(Ending::Arrived)) …
#pragma once

#include <cstdint>

#include "sim/carbot/steering.hpp"

namespace vagus::sim::carbot {

enum class MotionKind : int16_t { None, Move, Turn, Curve, Steer };
enum class MotionState : int16_t { AtRest, Drives, Brakes, Paused };

// What has come to its end.
enum class Ending : uint8_t { Arrived = 1, Turned = 2, Halted = 4 };

class Motion {
public:
    // Each takes the place of the command before. Metres and radians, a second; speeds above 0.
    void move(double distance, double speed);
    void turn(double angle, double speed);
    // Negative speed: backwards. The heading changes by `angle` in any case.
    void curve(double radius, double angle, double speed);
    void steer(double speed, double rate);
    void brake();
    void pause();   // keeps the command
    void resume();  // of a paused one
    // As brake(), because the commander is gone. False, and nothing done, without a command.
    bool cut();

    // One step of kArenaStep: where the wheels shall go, given how they are.
    WheelPair step(const WheelPair& wheels);

    MotionKind kind() const { return kind_; }
    MotionState state() const { return state_; }
    // Of move and curve in metres, of turn in radians; never negative.
    double left() const;
    // Has it happened since it was last asked?
    bool take(Ending what);

private:
    // The way to go, as a wheel rolls it.
    struct Path {
        WheelPair aim;         // servos of the whole path, and the direction (1, -1) of each wheel
        Twist unit;            // of the body for each metre of a wheel
        double left = 0;       // m of a wheel still to go
        double speed_max = 0;  // m/s of a wheel
        double scale = 1;      // m of a wheel for each metre or radian of the command
        bool endless = false;  // steer: nothing to arrive at
    };
    struct Order {
        double ahead = 0;  // of the body for each metre or radian of the command
        double turn = 0;
        double left = 0;  // metres or radians
        double speed_max = 0;
        bool endless = false;
    };

    void start(MotionKind kind, const Order& order);
    void count_way(const WheelPair& wheels);
    WheelPair halt(const WheelPair& wheels);
    WheelPair follow_path(const WheelPair& wheels);
    WheelPair steady(const WheelPair& wheels);
    void finish();
    void note(Ending what) { done_ = static_cast<uint8_t>(done_ | static_cast<uint8_t>(what)); }

    MotionKind kind_ = MotionKind::None;
    MotionState state_ = MotionState::AtRest;
    Path path_;
    bool ending_ = false;   // the way is done, the wheels still roll
    bool halting_ = false;  // someone waits for Halted
    uint8_t done_ = 0;
    double speed_ = 0;  // of the wheels, as told last
};

}  // namespace vagus::sim::carbot
