// The program and the node's id over a restart, in the two slots that a board keeps (board.hpp). A
// slot is
//
//     byte 0   u16 number: of two whole slots the later one counts
//     byte 2   u16 id of the node
//     byte 4   u16 words of the program
//     byte 6   u16 kSlotMark
//     byte 8   u32 CRC-32 of all other bytes: 0 to 7, then the program
//     byte 12  the program
//
// A save goes to the slot that does not count, and writes its CRC last. So when the power goes, at
// whatever byte, one slot is as it was: the node starts the program it had, or the new one, never a
// piece. Saving takes one step for each turn of the loop; a new program that comes in between ends
// it, and nothing has changed.
#pragma once

#include <stdint.h>

namespace vagus {
namespace firmware {

constexpr uint16_t kSlotMark = 0x7641;  // "Av"
constexpr uint16_t kSlotHeader = 12;
constexpr uint8_t kSlots = 2;

// All zero at the start.
struct Store {
    const uint16_t* program;  // what is being saved; nullptr if nothing is
    uint16_t words;
    uint16_t id;
    uint16_t at;        // words written
    uint16_t number;    // of the slot that counts
    uint8_t slot;       // that counts, or kSlots
    uint32_t checksum;  // so far
};

struct Kept {
    uint16_t id;
    uint16_t words;
};

// Reads the program that counts to `program`, which has room for `room` words. Gives words 0 if
// there is none; `program` is as it was then. To be called once, before any save.
Kept load(Store& store, uint16_t* program, uint16_t room);

void begin_save(Store& store, const uint16_t* program, uint16_t words, uint16_t id);
inline bool is_saving(const Store& store) {
    return store.program != nullptr;
}
// One step; true when this was the last one, and the program is kept.
bool save_step(Store& store);
// The program is about to change: what was saved before goes on to count.
void end_save(Store& store);

}  // namespace firmware
}  // namespace vagus
