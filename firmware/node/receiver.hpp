// Frames out of a serial line on which bytes get lost, on a microcontroller: the interrupt puts
// bytes into a ring, and the frames are read where they lie. What counts as a frame, and how the
// next one is found again, follows docs/decisions/0055; the reader of hosts (wire/line_reader.hpp)
// has a buffer of its own and three times the code.
//
//     void interrupt() { receive_byte(receiver, uart.data); }
//
//     Received frame;
//     while (next_frame(receiver, now_ms, kNobody, frame)) obey(frame);
//
// A header must be possible: its size legal, its type known, its source not 0xffff. One that is
// likely, too (an event as most are, or a message of section 2), makes a frame when the last byte
// is there. One that is only possible needs a witness: a likely header behind it, or silence.
// SetBytecode needs one always, so that a piece of a program that lost bytes, and took those of the
// next frame instead, is not stored. Once something was wrong, frames are likely ones with a
// witness, until there was one, or a silence.
#pragma once

#include <stdint.h>

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

// All zero at the start.
struct Receiver {
    uint8_t ring[kReceiveRoom];
    volatile uint16_t head;  // where the next byte goes; the interrupt's
    volatile uint16_t tail;  // the first byte that was not used yet
    volatile uint16_t lost;  // bytes that found no room
    uint16_t seen;           // head, when the time was last looked at
    uint32_t last_ms;        // when that was another
    uint16_t began_ms;       // when the frame in front came to the front; low half of the time
    uint16_t skipped;        // bytes that belonged to no frame; wraps
    bool doubt;              // something was wrong, and no frame with a witness came since
};

struct Received {
    uint16_t source;
    uint16_t type;
    uint16_t count;  // words; an odd last byte does not count
    uint16_t words[kWordsMax];
};

// From the interrupt.
void receive_byte(Receiver& receiver, uint8_t byte);

// The next frame; false if there is none yet. A command to `busy`, a node that cannot answer now,
// stays where it is until that is over, and so does all behind it.
constexpr uint16_t kNobody = wire::kInvalidId;
bool next_frame(Receiver& receiver, uint32_t now_ms, uint16_t busy, Received& frame);

// Bytes wait: for more of them, or for a silence.
inline bool has_bytes(const Receiver& receiver) {
    return receiver.head != receiver.tail;
}

}  // namespace firmware
}  // namespace vagus
