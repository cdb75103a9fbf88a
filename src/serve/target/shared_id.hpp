// What is said of two nodes that have one number: to the pages, and to the fleet.
#pragma once

#include <fmt/format.h>

#include <string>

#include "debug/network.hpp"

namespace vagus::serve {

inline std::string shared_id_words(const debug::NodeView& node) {
    return fmt::format("two nodes have the number {}: {} and {}; give one of them another", node.id,
                       node.name, node.other_name.empty() ? node.name : node.other_name);
}

}  // namespace vagus::serve
