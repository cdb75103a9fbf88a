// The program and the node's id over a restart, in the two slots that a board keeps (board.hpp). A
// slot is
//
//     byte 0   u16 number: of two whole slots the later one counts
//     byte 2   u16 id of the node
//     byte 4   u16 pairs of words of the program
//     byte 6   u16 kSlotMark
//     byte 8   the program, up to its last word that is not zero
//     then     u32 CRC-32 of all before
//
// A save goes to the slot that does not count, and writes its CRC last. So when the power goes, at
// whatever byte, one slot is as it was: the node starts the program it had, or the new one, never a
// piece. Saving takes one step for each turn of the loop; a new program that comes in between ends
// it, and nothing has changed.
#pragma once

#include <stdint.h>

namespace vagus {
namespace firmware {

constexpr uint16_t kSlotMark = 0x7642;  // "Bv"
constexpr uint16_t kSlotOverhead = 12;  // bytes beside the program
constexpr uint8_t kSlots = 2;

// All zero at the start.
struct Store {
    uint16_t number;    // of the slot that counts
    uint16_t id;        // that is being saved
    uint16_t pairs;     // of words, that are being saved
    uint16_t at;        // pairs written, header included
    uint32_t checksum;  // so far
    uint8_t slot;       // that the next save goes to
    bool is_saving;
};

// Reads the program that counts into the board's bytecode, which is zero before; gives the id that
// was saved with it. 0 if there is none: then the bytecode is zero. To be called once, before any
// save.
uint16_t load(Store& store);

// The board's bytecode is going to be saved.
void begin_save(Store& store, uint16_t id);
// One step; true when this was the last one, and the program is kept.
bool save_step(Store& store);
// The program is about to change: what was saved before goes on to count.
inline void end_save(Store& store) {
    store.is_saving = false;
}

}  // namespace firmware
}  // namespace vagus
