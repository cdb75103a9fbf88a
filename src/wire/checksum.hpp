// CRC-32 of IEEE 802.3 (the one of zlib) over words as they travel, low byte first; bit by bit,
// since a table would fill 1 KB of a microcontroller.
//
//     uint32_t checksum = kChecksumBegin;
//     for (const uint16_t word : words) checksum = add_to_checksum(checksum, word);
//     checksum = ~checksum;
#pragma once

#include <stdint.h>

namespace vagus {
namespace wire {

constexpr uint32_t kChecksumBegin = 0xffffffff;

[[gnu::noinline]] inline uint32_t add_to_checksum(uint32_t checksum, uint16_t word) {
    checksum ^= word;
    for (uint8_t bit = 0; bit < 16; ++bit) {
        checksum = (checksum >> 1) ^ ((checksum & 1) != 0 ? 0xedb88320u : 0);
    }
    return checksum;
}

// ---- What a node with the variable `_program` tells (docs/vm.md, "Which program is it?") ----

constexpr uint32_t kNoProgram = 0;
constexpr uint32_t kProgramUnknown = 0xffffffff;  // its pieces did not come one behind the other

// Of a program whose first word is `first`. A checksum that would say "none" is told as 1.
inline uint32_t program_mark(uint16_t first, uint32_t checksum) {
    if (first == 0) return kNoProgram;
    return ~checksum == kNoProgram ? 1 : ~checksum;
}

}  // namespace wire
}  // namespace vagus
