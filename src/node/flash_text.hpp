// Texts that end with '\0', in flash on an AVR, as the strings of messages.
#pragma once

#include <stdint.h>

#include "isa/flash.hpp"
#include "wire/bytes.hpp"

namespace vagus {
namespace node {

constexpr uint16_t kTextMax = 255;  // bytes: what the length byte of a string can say (D16)

// How many bytes of `text` to send: at most `limit`, which is at most kTextMax, and whole UTF-8
// characters.
inline uint8_t text_size(const char* text, uint16_t limit) {
    uint16_t size = 0;
    while (size < limit && flash_read(text + size) != '\0') ++size;
    // The byte behind the last one continues a character: then that one is cut, and goes.
    while (size > 0 && (static_cast<uint8_t>(flash_read(text + size)) & 0xc0) == 0x80) --size;
    return static_cast<uint8_t>(size);
}

inline void write_text(wire::Writer& out, const char* text, uint16_t limit) {
    const uint8_t size = text_size(text, limit);
    out.u8(size);
    for (uint8_t i = 0; i < size; ++i) out.u8(static_cast<uint8_t>(flash_read(text + i)));
}

}  // namespace node
}  // namespace vagus
