// Tells when a node that moves something must end what its program has commanded because the
// program is paused (docs/carbot.md, "When its script does not run"): at a breakpoint, by Pause, in
// steps.
// Stop, Reset, new bytecode and faults end it at once (MachineDefinition::broken_off).
//
//     Gate gate;
//     if (gate.shuts(machine, around)) motion.cut();  // each millisecond
//
// It acts in control steps: a pause that is shorter ends nothing, nor does one during which the
// clock of the world stops too.
#pragma once

#include "sim/machine.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

class Gate {
public:
    bool shuts(const Machine& machine, const Surroundings& around) {
        const bool paused = !machine.runs() && !around.clock_stops_with_nodes;
        paused_for_ = paused ? paused_for_ + kNodeStep : Duration::zero();
        return paused_for_ >= kPhysicsStep;
    }

private:
    Duration paused_for_{};
};

}  // namespace vagus::sim::carbot
