#include "firmware/node/sender.hpp"

namespace vagus {
namespace firmware {

namespace {

void put(Sender& sender, uint8_t& head, uint8_t byte) {
    sender.ring[head] = byte;
    head = static_cast<uint8_t>(head + 1);
}

void put_word(Sender& sender, uint8_t& head, uint16_t word) {
    put(sender, head, static_cast<uint8_t>(word & 0xff));
    put(sender, head, static_cast<uint8_t>(word >> 8));
}

}  // namespace

bool has_room(const Sender& sender, uint16_t size) {
    return size <= static_cast<uint8_t>(sender.tail - sender.head - 1);
}

// The interrupt sees nothing of the frame before it is whole.
bool queue(Sender& sender, const wire::Frame& frame) {
    const uint16_t left_free = wire::is_user_event(frame.type) ? kRoomOfMessages : 0;
    if (!has_room(sender, static_cast<uint16_t>(wire::kHeaderSize + frame.size + left_free)))
        return false;
    uint8_t head = sender.head;
    put_word(sender, head, frame.size);
    put_word(sender, head, frame.source);
    put_word(sender, head, frame.type);
    for (uint16_t i = 0; i < frame.size; ++i) put(sender, head, frame.payload[i]);
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
