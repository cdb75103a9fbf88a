// What the node says, waiting for the serial line, in the order in which it was said. Messages are
// made where they wait. Nothing waits for room: what finds none is dropped whole. User events leave
// half of the room to all other messages; so a script that emits without end can neither stop the
// node nor keep its answers from the host.
//
//     begin_message(sender, id, type);                 // from the loop
//     put_byte(sender, byte);                          // each byte of the payload
//     if (!end_message(sender)) ++dropped;
//     void interrupt() { if (take_byte(sender, byte)) uart.data = byte; }
#pragma once

#include <stdint.h>

#include "firmware/node/shared.hpp"

namespace vagus {
namespace firmware {

// Bytes; one of them stays free. Indices of 8 bits go round by themselves, and every processor
// reads them at once.
constexpr uint16_t kSendRoom = 256;
// Of these, for all that is no user event.
constexpr uint8_t kRoomOfMessages = 128;

// All zero at the start. The interrupt moves `tail`, the loop all else.
struct Sender {
    Shared<uint8_t> head;  // behind the last whole message
    Shared<uint8_t> tail;
    uint8_t end;   // of the message that is being made
    uint8_t room;  // bytes that may wait, this message included; 0 when it did not fit
    uint8_t ring[kSendRoom];
};

void begin_message(Sender& sender, uint16_t source, uint16_t type);
void put_byte(Sender& sender, uint8_t byte);
// False if there was no room.
bool end_message(Sender& sender);

// A message of so many bytes, header included, would find room.
bool has_room(const Sender& sender, uint8_t size);

// From the interrupt. False if nothing waits.
bool take_byte(Sender& sender, uint8_t& byte);

}  // namespace firmware
}  // namespace vagus
