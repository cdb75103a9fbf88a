// What the node says, waiting for the serial line: one ring for user events, one for all other
// messages, which go first. Nothing waits for room: what finds none is dropped whole, and counted.
// So a script that emits without end can neither stop the node nor keep its answers from the host.
//
//     queue(sender, frame);                            // from the loop
//     void interrupt() { if (take_byte(sender, byte)) uart.data = byte; }
#pragma once

#include <stdint.h>

#include "wire/frame.hpp"

namespace vagus {
namespace firmware {

// Of each ring, in bytes; one byte stays free. A power of two that fits 8 bits, which every
// processor reads at once.
constexpr uint8_t kSendRoom = 128;

// The interrupt moves `tail`, the loop moves `head`.
struct SendRing {
    uint8_t bytes[kSendRoom];
    volatile uint8_t head;
    volatile uint8_t tail;
};

// All zero at the start.
struct Sender {
    SendRing messages;
    SendRing events;
    SendRing* current;          // whose frame is being sent
    uint16_t left;              // bytes of it
    uint16_t dropped_events;    // wraps
    uint16_t dropped_messages;  // wraps
};

void queue(Sender& sender, const wire::Frame& frame);

// A message of so many bytes, header included, would not be dropped.
bool has_room(const Sender& sender, uint8_t size);

// From the interrupt. False if nothing waits.
bool take_byte(Sender& sender, uint8_t& byte);

}  // namespace firmware
}  // namespace vagus
