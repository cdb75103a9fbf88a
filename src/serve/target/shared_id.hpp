// What is said of two nodes that have one number: to the pages, and to the fleet.
#pragma once

#include <fmt/format.h>

#include <string>

#include "debug/network.hpp"

namespace vagus::serve {

// That there are two is known before, or without, the name of the other one.
inline std::string shared_id_words(const debug::NodeView& node) {
    const std::string names = node.other_name.empty()
                                  ? fmt::format(", one of them {}", node.name)
                                  : fmt::format(": {} and {}", node.name, node.other_name);
    return fmt::format("two nodes have the number {}{}; give one of them another", node.id, names);
}

}  // namespace vagus::serve
