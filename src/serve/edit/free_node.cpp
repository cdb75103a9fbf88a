#include "serve/edit/free_node.hpp"

#include <set>
#include <string_view>

namespace vagus::serve {

namespace {

std::vector<std::string_view> node_names(sim::RobotType type) {
    switch (type) {
        case sim::RobotType::Thymio2:
            return {"thymio-II"};
        case sim::RobotType::Epuck:
            return {"e-puck"};
        case sim::RobotType::Carbot:
            return {"drive", "bumper", "range", "head"};
    }
    return {};
}

// By its number, or a plain script, which is for any node.
bool has_script(const NewNode& node, const Scripts& scripts) {
    const ScriptPart* part = scripts.for_node(node.name, node.id);
    return part && (part->node_id == node.id || part->node.empty());
}

}  // namespace

std::vector<WorldNode> nodes_of_world(const sim::WorldDefinition& world) {
    std::vector<WorldNode> nodes;
    for (size_t robot = 0; robot < world.robots.size(); ++robot) {
        const sim::RobotDefinition& one = world.robots[robot];
        if (!one.project.empty()) continue;  // its nodes are for the scripts of that project
        const char* args = one.type == sim::RobotType::Epuck ? "args" : "event.args";
        uint16_t id = one.node;
        for (const std::string_view name : node_names(one.type)) {
            nodes.push_back({{std::string(name), id++, args}, robot});
        }
    }
    return nodes;
}

const WorldNode* node_without_script(const std::vector<WorldNode>& nodes, const Scripts& scripts) {
    for (const WorldNode& one : nodes) {
        if (!has_script(one.node, scripts)) return &one;
    }
    return nullptr;
}

uint16_t unused_number(const std::vector<WorldNode>& nodes, const Scripts& scripts) {
    std::set<uint16_t> used;
    for (const WorldNode& one : nodes) used.insert(one.node.id);
    for (const ScriptPart& part : scripts.parts()) used.insert(part.node_id);
    uint16_t number = 1;
    while (used.contains(number)) ++number;
    return number;
}

}  // namespace vagus::serve
