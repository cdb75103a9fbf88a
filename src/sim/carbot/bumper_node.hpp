// The node `bumper` of a Carbot: touch sectors around the hull, and the escape button.
#pragma once

#include <vector>

#include "sim/carbot/touch_ring.hpp"
#include "sim/machine.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

class BumperNode {
public:
    explicit BumperNode(uint16_t id);

    Machine& machine() { return machine_; }
    // Each millisecond: what touches `body`.
    void sense(const Surroundings& around, BodyId body);
    void set_escape(bool pressed);

private:
    Machine machine_;
    TouchRing ring_;
    std::vector<TouchedPart> parts_;  // of sense(), kept for its memory
};

}  // namespace vagus::sim::carbot
