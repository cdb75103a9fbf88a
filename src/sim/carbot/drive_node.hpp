// The node `drive` of a Carbot: two steered wheels, odometry, and the driving commands as natives.
// Its wheels obey its program only while that runs (sim/carbot/gate.hpp).
#pragma once

#include "sim/arena.hpp"
#include "sim/carbot/chassis.hpp"
#include "sim/carbot/gate.hpp"
#include "sim/carbot/motion.hpp"
#include "sim/carbot/odometry.hpp"
#include "sim/machine.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

// What its natives change beside variables.
struct Driver {
    Motion motion;
    Odometry odometry;
    int16_t* command = nullptr;  // the variable motion.kind
    bool owes_halted = false;    // the node itself has ended a command: its program is to know

    // At once, for a handler that runs in the same millisecond.
    void tell_command() const;
    // The program that gave the command does not run.
    void cut();
};

class DriveNode {
public:
    // `seed` is that of the slip of its wheels.
    DriveNode(uint16_t id, uint64_t seed);
    void reseed(uint64_t seed) { chassis_.reseed(seed); }

    Machine& machine() { return machine_; }
    // Each millisecond: variables, local events.
    void sense(const Surroundings& around);
    // Before each step of the arena: moves wheels and odometry, gives the motion of the body.
    Drive drive();

private:
    void write_variables();
    void raise_endings();

    Driver driver_;
    Machine machine_;
    Chassis chassis_;
    Gate gate_;
};

}  // namespace vagus::sim::carbot
