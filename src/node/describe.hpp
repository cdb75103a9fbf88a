// The description of a node as messages: 0x9000, then all variables, local events and natives
// (section 2.2).
#pragma once

#include "node/node.hpp"

namespace vagus {
namespace node {

// Values of `fragment` in GetNodeDescriptionFragment (section 2.9).
constexpr int16_t kFragmentHeader = -1;
constexpr int16_t kFragmentAll = -2;

void send_description(Node& node);

// kFragmentHeader, kFragmentAll, or one item: variables are counted first, then local events, then
// natives. Sends nothing for an item that does not exist.
void send_description_fragment(Node& node, int16_t fragment);

}  // namespace node
}  // namespace vagus
