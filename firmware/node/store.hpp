// The bytecode and the node's id over a restart, in the two slots that a board keeps (board.hpp). A
// slot is, in units of four bytes,
//
//     number of the save (u16), id of the node (u16)
//     which program it is (u32, node::program())
//     all words of the bytecode, in pairs
//     CRC-32 of all before
//
// and is kept inverted: what is zero, as most of a bytecode is, stays as it was erased. A save goes
// to the slot that does not count, and writes its CRC last. So when the power goes, at whatever
// byte, one slot is as it was: the node starts the program it had, or the new one, never a piece.
// Saving takes one step for each turn of the loop; a new program that comes in between ends it, and
// nothing has changed.
#pragma once

#include <stdint.h>

namespace vagus {
namespace firmware {

constexpr uint16_t kSlotOverhead = 12;  // bytes beside the bytecode
constexpr uint8_t kSlots = 2;

// Places in Store::head.
constexpr uint8_t kNumber = 0;
constexpr uint8_t kId = 1;
constexpr uint8_t kProgram = 2;  // low word first
constexpr uint8_t kHeadWords = 4;

// All zero at the start.
struct Store {
    uint16_t head[kHeadWords];  // the first units of the last save
    uint16_t at;                // units that are done
    uint32_t checksum;          // of these
    uint8_t slot;               // that the next save goes to
    bool is_saving;
};

// Reads what was saved last into the board's bytecode; gives the id that was saved with it, and
// which program it is. Both 0 if there is nothing: then the bytecode is that of no program. To be
// called once, before any save.
uint16_t load(Store& store, uint32_t& program);

// The board's bytecode is going to be saved.
void begin_save(Store& store, uint16_t id, uint32_t program);
// One step; true when this was the last one, and the program is kept.
bool save_step(Store& store);
// The program is about to change: what was saved before goes on to count.
inline void end_save(Store& store) {
    store.is_saving = false;
}

}  // namespace firmware
}  // namespace vagus
