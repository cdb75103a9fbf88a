#include "node/message.hpp"

#include "isa/flash.hpp"

namespace vagus {
namespace node {

namespace {

uint16_t text_size(const char* text, uint16_t limit) {
    uint16_t size = 0;
    while (size < limit && flash_read(text + size) != '\0') ++size;
    // The byte behind the last one continues a character: then that one is cut, and goes.
    while (size > 0 && (static_cast<uint8_t>(flash_read(text + size)) & 0xc0) == 0x80) --size;
    return size;
}

}  // namespace

Message::Message(Node& node, uint16_t type) : node_(node) {
    frame_.source = node.vm.id;
    frame_.type = type;
    frame_.size = 0;
}

void Message::byte(uint8_t byte) {
    if (frame_.size < wire::kPayloadMax) frame_.payload[frame_.size] = byte;
    ++frame_.size;
}

void Message::word(uint16_t word) {
    byte(static_cast<uint8_t>(word & 0xff));
    byte(static_cast<uint8_t>(word >> 8));
}

void Message::text(const char* text, uint16_t limit) {
    const uint16_t size = text_size(text, limit);
    byte(static_cast<uint8_t>(size));
    for (const char* at = text; at != text + size; ++at) byte(static_cast<uint8_t>(flash_read(at)));
}

void Message::send() {
    node_.board->transmit(node_, frame_);
}

}  // namespace node
}  // namespace vagus
