// The node `range` of a Carbot: an ultrasonic sensor on a rotator, which obeys its program only
// while that runs (sim/carbot/gate.hpp).
#pragma once

#include "sim/carbot/gate.hpp"
#include "sim/carbot/sonar.hpp"
#include "sim/machine.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

class RangeNode {
public:
    // `seed` is that of the sensor's noise.
    RangeNode(uint16_t id, uint64_t seed);
    void reseed(uint64_t seed) { sonar_.reseed(seed); }

    Machine& machine() { return machine_; }
    // Each millisecond.
    void sense(const Surroundings& around, BodyId body);
    // Where it looked last, for drawings.
    std::optional<Beam> look(const Pose& robot) const { return sonar_.look(robot); }

private:
    void raise_endings();

    Sonar sonar_;
    Machine machine_;
    Gate gate_;
};

}  // namespace vagus::sim::carbot
