// Nodes that need no node file, because this program has them in itself: the simulated robots, and
// the standard software node.
#pragma once

#include <string_view>

#include "aesl/target.hpp"

namespace vagus::session {

// By the name that a node of a project has: "thymio-II" is the simulated Thymio, "e-puck" and what
// begins so the simulated e-puck, "drive", "bumper", "range" and "head" are the nodes of the
// simulated Carbot, everything else is the software node of standard_target.hpp under this name.
aesl::Target known_node(std::string_view name);

}  // namespace vagus::session
