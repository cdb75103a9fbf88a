// How a node that was told to stop is named to people.
#pragma once

#include <string>

#include "session/stop_node.hpp"

namespace vagus::session {

// "node 5 (rover)"; one that died before it told its name has none.
inline std::string number_and_name(const StopNode& node) {
    const std::string number = "node " + std::to_string(node.node);
    return node.name.empty() ? number : number + " (" + node.name + ")";
}

}  // namespace vagus::session
