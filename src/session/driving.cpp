#include "session/driving.hpp"

#include <algorithm>

namespace vagus::session {

namespace {

bool overlap(const debug::VariableRange& one, const debug::VariableRange& other) {
    return one.address < other.address + other.count && other.address < one.address + one.count;
}

bool same(const debug::VariableRange& one, const debug::VariableRange& other) {
    return one.address == other.address && one.count == other.count;
}

// Calls `use` with the words that the safe stop of the node writes, and the values, until it says
// true.
template <typename Use>
bool any_of_safe(const debug::Network& network, uint16_t node, const SafeStop& safe,
                 const Use& use) {
    const debug::NodeView* const view = network.node(node);
    const auto found = view == nullptr ? safe.end() : safe.find(view->name);
    if (found == safe.end()) return false;
    return std::any_of(found->second.set.begin(), found->second.set.end(), [&](const auto& one) {
        const auto named = network.variable(node, one.first);
        return named.ok() && use(named.value(), one.second);
    });
}

}  // namespace

bool drives(const debug::Network& network, uint16_t node, const debug::VariableRange& range,
            const SafeStop& safe) {
    return any_of_safe(network, node, safe,
                       [&](const auto& named, auto&) { return overlap(named, range); });
}

std::string why_not_from_afar(const debug::Network& network, uint16_t node,
                              const std::string& variable, const std::vector<int16_t>& values,
                              const SafeStop& safe) {
    const auto range = network.variable(node, variable);
    if (!range.ok() || !drives(network, node, range.value(), safe)) return "";
    const bool is_safe = any_of_safe(network, node, safe, [&](const auto& named, const auto& its) {
        return same(named, range.value()) && its == values;
    });
    if (is_safe) return "";
    return variable +
           " drives the robot, and would go on when nobody is there any more; set it in the "
           "robot's own studio, or send an event that its script handles";
}

}  // namespace vagus::session
