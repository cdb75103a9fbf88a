// What makes a robot stand: Stop alone leaves a Thymio's targets as they are, and it drives on.
// One definition for each kind of node, by the variables that it has.
#pragma once

#include <string>
#include <vector>

#include "aesl/target.hpp"

namespace vagus::serve {

// Variables of the node that must be 0 for its wheels to stand; empty if it has none of its own
// (Carbot's drive node brakes by itself when nobody keeps it alive).
std::vector<std::string> driving_variables(const aesl::Target& node);

}  // namespace vagus::serve
