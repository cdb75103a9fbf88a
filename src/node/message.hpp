// A message that a node sends: words and texts, one behind the other. Nobody outside of this folder
// includes it.
//
//     begin_message(node, wire::MessageType::NamedVariableDescription);
//     put_word(node, variable.size);
//     put_text(node, variable.name);
//     end_message(node);
#pragma once

#include <stdint.h>

#include "node/node.hpp"

namespace vagus {
namespace node {

constexpr uint16_t kTextMax = 255;  // bytes: what the length byte of a string can say (D16)

// What was begun and not ended is forgotten.
void begin_message(Node& node, uint16_t type);
inline void begin_message(Node& node, wire::MessageType type) {
    begin_message(node, static_cast<uint16_t>(type));
}
void put_word(Node& node, uint16_t word);
// `text` ends with '\0' and is in flash on an AVR. Of a longer one than `limit`, at most kTextMax
// bytes, as many whole characters (UTF-8) as fit.
void put_text(Node& node, const char* text, uint16_t limit = kTextMax);
// False once there was more than a payload takes: then the message must not be ended.
inline bool fits(const Node& node) {
    return node.message_size <= wire::kPayloadMax;
}
void end_message(Node& node);

}  // namespace node
}  // namespace vagus
