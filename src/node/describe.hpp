// The description of a node as messages: 0x9000, then all variables, local events and natives
// (section 2.2). Nobody outside of this folder includes it.
#pragma once

#include "node/node.hpp"

namespace vagus {
namespace node {

void send_header(Node& node);

// What is behind the header, one message each: variables first, then local events, then
// natives.
uint16_t item_count(const Node& node);
// Sends nothing for an item that does not exist.
void send_item(Node& node, uint16_t item);

}  // namespace node
}  // namespace vagus
