#include "firmware/node/sender.hpp"

#include <stddef.h>

namespace vagus {
namespace firmware {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ &&
                  offsetof(wire::Frame, payload) == wire::kHeaderSize,
              "a frame lies in memory as it is sent");

bool has_room(const Sender& sender, uint16_t size) {
    return size <= static_cast<uint8_t>(sender.tail - sender.head - 1);
}

// The interrupt sees nothing of the frame before it is whole.
bool queue(Sender& sender, const wire::Frame& frame) {
    const uint16_t left_free = wire::is_user_event(frame.type) ? kRoomOfMessages : 0;
    const uint16_t size = static_cast<uint16_t>(wire::kHeaderSize + frame.size);
    if (!has_room(sender, static_cast<uint16_t>(size + left_free))) return false;
    const uint8_t* const bytes = reinterpret_cast<const uint8_t*>(&frame);
    uint8_t head = sender.head;
    for (uint16_t i = 0; i < size; ++i) sender.ring[head++] = bytes[i];
    sender.head = head;
    return true;
}

bool take_byte(Sender& sender, uint8_t& byte) {
    const uint8_t tail = sender.tail;
    if (tail == sender.head) return false;
    byte = sender.ring[tail];
    sender.tail = static_cast<uint8_t>(tail + 1);
    return true;
}

}  // namespace firmware
}  // namespace vagus
