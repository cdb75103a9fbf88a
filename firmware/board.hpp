// What a board does for the node that runs on it: all that is particular to a microcontroller, in
// one file for each board (firmware/cortex-m/microbit.cpp, firmware/avr/atmega1284p.cpp …).
// Everything else is firmware/node, the same for all.
//
// Bringing up a new board is writing these functions and calling, from its interrupts, the two at
// the end.
#pragma once

#include <stdint.h>

#include "vm/vm.hpp"

namespace vagus {
namespace board {

// ---- Written for each board ----

// Clock, pins, serial line (8N1) and a clock of milliseconds; interrupts are on when it returns.
void begin();
// Milliseconds since begin(). Wraps.
uint16_t now_ms();

// Interrupts off; gives what release() needs to make it as it was.
uint8_t hold();
void release(uint8_t before);
// Until an interrupt comes: at the latest that of the clock.
void sleep();

// Bytes wait to be sent: from here on the board asks for them, one by one, until there are none.
void start_sending();

// Lamps, the lowest bit is the first; those that the board lacks are ignored.
void show_leds(uint16_t leds);
// The buttons that are pressed, the lowest bit is the first.
uint16_t buttons();

// Only of a board that is built with VAGUS_MOTORS: -255 … 255 of full power each, the sign is the
// direction; beyond is as much as there is. 0 brakes or lets roll, as begin() and a reset do.
void set_motors(int16_t left, int16_t right);

// The loop goes round. A board that has a watchdog is reset by it when this was not called for a
// second; an interrupt never calls it.
void alive();

// The number that this board got when it was made; 0 or 0xffff if it got none.
uint16_t first_id();
// Starts again as if just switched on. Does not return.
void restart();

// ---- The memory that outlasts a restart: two slots of kSlotBytes each ----

// From now on no read gives what was there; the first four bytes are gone when it returns.
void erase_slot(uint8_t slot);
// Bytes at .. at + 3 of a slot that has been erased; `at` is a multiple of 4. Each place is written
// once.
void write_slot(uint8_t slot, uint16_t at, uint32_t value);
uint32_t read_slot(uint8_t slot, uint16_t at);

// ---- The machine and its memories (firmware/node/machine.hpp), and the node's name ----

extern const vm::Config kMachine;
extern const char kName[];  // in flash on an AVR

// ---- Called by the board from its interrupts ----

// A byte has come in.
void on_byte(uint8_t byte);
// The next byte to send; false if there is none: then the board waits for start_sending().
bool next_byte(uint8_t& byte);

}  // namespace board
}  // namespace vagus
