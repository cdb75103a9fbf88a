// For which node a new script is: one that the world has and that no script is for, else a number
// that nobody has. Two scripts with the number of one node would be one that is never loaded.
#pragma once

#include <vector>

#include "serve/edit/templates.hpp"
#include "serve/script/scripts.hpp"
#include "sim/definitions.hpp"

namespace vagus::serve {

// A node of a world, and which of its robots has it.
struct WorldNode {
    NewNode node;
    size_t robot = 0;
};

// In the order of the robots.
std::vector<WorldNode> nodes_of_world(const sim::WorldDefinition& world);

// The first node without a script of its own; nullptr if each has one.
const WorldNode* node_without_script(const std::vector<WorldNode>& nodes, const Scripts& scripts);

// The lowest number that neither a node of the world nor a script has.
uint16_t unused_number(const std::vector<WorldNode>& nodes, const Scripts& scripts);

}  // namespace vagus::serve
