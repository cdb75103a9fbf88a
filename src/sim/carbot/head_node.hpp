// The node `head` of a Carbot: infrared direction, colour of what is near, and the light on top.
#pragma once

#include "sim/machine.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

class HeadNode {
public:
    explicit HeadNode(uint16_t id);

    Machine& machine() { return machine_; }
    // Each millisecond.
    void sense(const Surroundings& around);

private:
    Machine machine_;
};

}  // namespace vagus::sim::carbot
