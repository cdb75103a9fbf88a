// What became of the nodes that were told to stop.
#pragma once

#include <vector>

#include "session/stop_node.hpp"

namespace vagus::serve {

using session::StopNode;

struct StopReport {
    std::vector<StopNode> nodes;
};

}  // namespace vagus::serve
