#include "firmware/node/sender.hpp"

#include "wire/protocol.hpp"

namespace vagus {
namespace firmware {

namespace {

constexpr uint8_t kRoom = kSendRoom - 1;

void put_word(Sender& sender, uint16_t word) {
    put_byte(sender, static_cast<uint8_t>(word & 0xff));
    put_byte(sender, static_cast<uint8_t>(word >> 8));
}

}  // namespace

bool has_room(const Sender& sender, uint8_t size) {
    return size <= static_cast<uint8_t>(sender.tail.load() - sender.head.load() - 1);
}

void begin_message(Sender& sender, uint16_t source, uint16_t type) {
    sender.end = sender.head.load();
    sender.room = wire::is_user_event(type) ? kRoom - kRoomOfMessages : kRoom;
    put_word(sender, 0);
    put_word(sender, source);
    put_word(sender, type);
}

void put_byte(Sender& sender, uint8_t byte) {
    const uint8_t waiting = static_cast<uint8_t>(sender.end - sender.tail.load());
    if (waiting >= sender.room) {
        sender.room = 0;
        return;
    }
    sender.ring[sender.end] = byte;
    sender.end = static_cast<uint8_t>(sender.end + 1);
}

// The interrupt sees nothing of the message before. A message that fits the ring is shorter than
// 256 bytes: the low byte of its size says it all.
bool end_message(Sender& sender) {
    if (sender.room == 0) return false;
    const uint8_t head = sender.head.load();
    sender.ring[head] = static_cast<uint8_t>(sender.end - head - wire::kHeaderSize);
    sender.head.store(sender.end);
    return true;
}

bool take_byte(Sender& sender, uint8_t& byte) {
    const uint8_t tail = sender.tail.in_interrupt();
    if (tail == sender.head.in_interrupt()) return false;
    byte = sender.ring[tail];
    sender.tail.in_interrupt(static_cast<uint8_t>(tail + 1));
    return true;
}

}  // namespace firmware
}  // namespace vagus
