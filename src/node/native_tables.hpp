// What a node does with the natives of its description. In two files, and a program links one of
// them: native_tables.cpp, or no_natives.cpp for a node that has none and shall be small. Nobody
// outside of this folder includes it.
#pragma once

#include "node/node.hpp"

namespace vagus {
namespace node {

uint16_t native_count(const Description& description);
// Sends nothing for a native that does not exist.
void send_native(Node& node, uint16_t id);
// False for a native that does not exist.
bool call_native(Node& node, uint16_t id);

}  // namespace node
}  // namespace vagus
