// The node `head` of a Carbot: infrared direction, colour of what is near, and the light on top.
#pragma once

#include "sim/drawing.hpp"
#include "sim/machine.hpp"
#include "sim/noise.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

class HeadNode {
public:
    // `seed` is that of the noise of its sensors.
    HeadNode(uint16_t id, uint64_t seed);
    void reseed(uint64_t seed) { noise_.reseed(seed); }

    Machine& machine() { return machine_; }
    // Each millisecond.
    void sense(const Surroundings& around, BodyId body);
    Lamp lamp() const;

private:
    void perceive(const Surroundings& around, BodyId body);

    Colour light_;
    Noise noise_;
    Machine machine_;
};

}  // namespace vagus::sim::carbot
