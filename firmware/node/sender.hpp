// What the node says, waiting for the serial line, in the order in which it was said. Nothing waits
// for room: what finds none is dropped whole. User events leave half of the room to all other
// messages; so a script that emits without end can neither stop the node nor keep its answers from
// the host.
//
//     if (!queue(sender, frame)) ++dropped;            // from the loop
//     void interrupt() { if (take_byte(sender, byte)) uart.data = byte; }
#pragma once

#include <stdint.h>

#include "wire/frame.hpp"

namespace vagus {
namespace firmware {

// Bytes; one of them stays free. Indices of 8 bits go round by themselves, and every processor
// reads them at once.
constexpr uint16_t kSendRoom = 256;
// Of these, for all that is no user event.
constexpr uint16_t kRoomOfMessages = 128;

// All zero at the start. The interrupt moves `tail`, the loop moves `head`.
struct Sender {
    volatile uint8_t head;
    volatile uint8_t tail;
    uint8_t ring[kSendRoom];
};

// False if there is no room.
bool queue(Sender& sender, const wire::Frame& frame);

// A message of so many bytes, header included, would find room.
bool has_room(const Sender& sender, uint16_t size);

// From the interrupt. False if nothing waits.
bool take_byte(Sender& sender, uint8_t& byte);

}  // namespace firmware
}  // namespace vagus
