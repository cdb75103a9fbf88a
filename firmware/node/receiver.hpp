// Frames out of a serial line on which bytes get lost, on a microcontroller: the interrupt puts
// bytes into a row, and the frames are read where they lie. What counts as a frame, and how the
// next one is found again, follows docs/decisions/0055; the reader of hosts (wire/line_reader.hpp)
// has a buffer of its own and three times the code.
//
//     void interrupt() { receive_byte(receiver, uart.data); }
//
//     while (next_frame(receiver, now_ms)) {
//         obey(front(receiver));
//         drop_front(receiver, now_ms);
//     }
//
// A header is likely if it is that of an event as most are, or of a message of section 2. It makes
// a frame when the last byte is there. Any other needs a witness: a likely header behind the frame,
// or silence. SetBytecode needs one always, so that a piece of a program that lost bytes, and took
// those of the next frame instead, is not stored. Once something was wrong, frames are likely ones
// with a witness, until there was one, or a silence.
#pragma once

#include <stdint.h>

#include "firmware/node/shared.hpp"
#include "wire/protocol.hpp"

namespace vagus {
namespace firmware {

// The longest frame, the header behind it, and what arrives at 115,200 baud within 4 ms.
constexpr uint16_t kReceiveRoom = 576;
// After so long a silence a frame that is complete needs no other witness …
constexpr uint16_t kWitness_ms = 20;
// … and the rest of one that is not will not come any more. Hosts that are busy pause within a
// frame.
constexpr uint16_t kBroken_ms = 250;
// The longest frame takes 46 ms at 115,200 baud: one that takes longer than this is none.
constexpr uint16_t kFrameWithin_ms = 500;
constexpr uint16_t kWordsMax = wire::kPayloadMax / 2;
// Types of section 2 that hosts send: from here on.
constexpr uint16_t kCommands = 0xa000;

// All zero at the start. Times are the low half of those of the board.
struct Receiver {
    Shared<uint16_t> end;            // bytes in the row; the interrupt counts up
    Shared<uint16_t> lost;           // bytes that found no room
    uint16_t begin;                  // the first byte that was not used yet
    uint16_t seen;                   // `end`, when the time was last looked at
    uint16_t seen_ms;                // when that was another
    uint16_t began_ms;               // when the frame in front came to the front
    uint16_t skipped;                // bytes that belonged to no frame; wraps
    bool doubt;                      // something was wrong, and no frame with a witness came since
    uint16_t row[kReceiveRoom / 2];  // words, so that those of a frame can be read where they lie
};

struct Received {
    uint16_t source;
    uint16_t type;
    const uint16_t* words;
    uint16_t count;  // of words; an odd last byte does not count
};

// From the interrupt.
void receive_byte(Receiver& receiver, uint8_t byte);

// A frame is in front. It stays there, and all behind it, until it is dropped.
bool next_frame(Receiver& receiver, uint16_t now_ms);
Received front(const Receiver& receiver);
void drop_front(Receiver& receiver, uint16_t now_ms);

}  // namespace firmware
}  // namespace vagus
