// The node `range` of a Carbot: an ultrasonic sensor on a rotator.
#pragma once

#include "sim/machine.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

class RangeNode {
public:
    explicit RangeNode(uint16_t id);

    Machine& machine() { return machine_; }
    // Each millisecond.
    void sense(const Surroundings& around);

private:
    Machine machine_;
};

}  // namespace vagus::sim::carbot
