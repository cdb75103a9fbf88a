// A message that a node is about to send: words and texts, one behind the other. Nobody outside of
// this folder includes it.
//
//     Message message(node, wire::MessageType::NamedVariableDescription);
//     message.word(variable.size);
//     message.text(variable.name);
//     message.send();
#pragma once

#include <stdint.h>

#include "node/node.hpp"

namespace vagus {
namespace node {

constexpr uint16_t kTextMax = 255;  // bytes: what the length byte of a string can say (D16)

class Message {
public:
    Message(Node& node, uint16_t type);
    Message(Node& node, wire::MessageType type) : Message(node, static_cast<uint16_t>(type)) {}

    void word(uint16_t word);
    // `text` ends with '\0' and is in flash on an AVR. Of a longer one than `limit`, at most
    // kTextMax bytes, as many whole characters (UTF-8) as fit.
    void text(const char* text, uint16_t limit = kTextMax);
    // False once there was more than a payload takes: then it must not be sent.
    bool fits() const { return frame_.size <= wire::kPayloadMax; }
    void send();

private:
    void byte(uint8_t byte);

    Node& node_;
    wire::Frame frame_;
};

}  // namespace node
}  // namespace vagus
