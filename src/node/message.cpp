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

void put_byte(Node& node, uint8_t byte) {
    if (node.message_size < wire::kPayloadMax) node.board->put(node, byte);
    ++node.message_size;
}

}  // namespace

void begin_message(Node& node, uint16_t type) {
    node.message_size = 0;
    node.board->begin(node, type);
}

void put_word(Node& node, uint16_t word) {
    put_byte(node, static_cast<uint8_t>(word & 0xff));
    put_byte(node, static_cast<uint8_t>(word >> 8));
}

void put_text(Node& node, const char* text, uint16_t limit) {
    const uint16_t size = text_size(text, limit);
    put_byte(node, static_cast<uint8_t>(size));
    for (const char* at = text; at != text + size; ++at) {
        put_byte(node, static_cast<uint8_t>(flash_read(at)));
    }
}

void end_message(Node& node) {
    node.board->end(node);
}

}  // namespace node
}  // namespace vagus
