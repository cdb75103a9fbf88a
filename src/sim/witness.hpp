// Is told, instruction by instruction, what the scripts of a world do: who wrote a variable last,
// which native was called from where, what started a handler. A world that has one runs on one
// thread and several times as slow; what happens is the same.
//
//     class Log final : public sim::Witness { … };
//     world.watch(&log);                                 // borrowed, until watch(nullptr)
#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace vagus::sim {

// A node of a world: which robot it belongs to, and its id.
struct WitnessedNode {
    uint32_t robot = 0;  // RobotId
    uint16_t id = 0;
};

class Witness {
public:
    Witness() = default;
    Witness(const Witness&) = delete;
    Witness& operator=(const Witness&) = delete;
    virtual ~Witness() = default;

    // What one does not ask for passes unseen.

    // A handler begins at pc: by the frame with that number (sim/frame_numbers.hpp; 0: not known) …
    virtual void began_by_frame(const WitnessedNode&, uint16_t /*pc*/, uint32_t /*frame*/) {}
    // … or by the local event, counted from 0.
    virtual void began_by_itself(const WitnessedNode&, uint16_t /*pc*/, uint8_t /*event*/) {}
    // The instruction at pc is executed next: all memories are still as they were. One at which a
    // breakpoint holds the node is told again when the node goes on.
    virtual void executes(const WitnessedNode&, uint16_t /*pc*/) {}
    // The instruction at pc wrote a value into a variable.
    virtual void wrote(const WitnessedNode&, uint16_t /*pc*/, uint16_t /*address*/,
                       int16_t /*value*/) {}
    // The instruction at pc called a native.
    virtual void called(const WitnessedNode&, uint16_t /*pc*/, uint16_t /*native*/) {}
    // A frame is sent, by the handler that runs at pc if one does …
    virtual void sends(const WitnessedNode&, uint16_t /*pc*/) {}
    // … and has its number now, in the same order.
    virtual void sent(const WitnessedNode&, uint32_t /*frame*/) {}
};

}  // namespace vagus::sim
