// Direct driving: who writes a variable that the safe stop of its node writes drives the robot.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "debug/network.hpp"
#include "session/safe_stop.hpp"

namespace vagus::session {

// The range has words that the safe stop of its node writes. By its words: a variable has more than
// one name, motor.left.target and motor.left.target[0].
bool drives(const debug::Network& network, uint16_t node, const debug::VariableRange& range,
            const SafeStop& safe);

// Why somebody whose connection to the robot is not known may not write that: nobody would notice
// that they are gone. Empty: it drives nothing, or it is what makes the node safe.
std::string why_not_from_afar(const debug::Network& network, uint16_t node,
                              const std::string& variable, const std::vector<int16_t>& values,
                              const SafeStop& safe);

}  // namespace vagus::session
