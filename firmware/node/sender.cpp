#include "firmware/node/sender.hpp"

namespace vagus {
namespace firmware {

namespace {

constexpr uint8_t kLast = kSendRoom - 1;

uint8_t waiting(const SendRing& ring) {
    return static_cast<uint8_t>(ring.head - ring.tail) & kLast;
}

void put(SendRing& ring, uint8_t byte, uint8_t& at) {
    ring.bytes[at] = byte;
    at = static_cast<uint8_t>(at + 1) & kLast;
}

void put_word(SendRing& ring, uint16_t word, uint8_t& at) {
    put(ring, static_cast<uint8_t>(word & 0xff), at);
    put(ring, static_cast<uint8_t>(word >> 8), at);
}

// The interrupt sees nothing of the frame before it is whole.
bool put_frame(SendRing& ring, const wire::Frame& frame) {
    const uint8_t room = static_cast<uint8_t>(kLast - waiting(ring));
    if (static_cast<uint16_t>(frame.size + wire::kHeaderSize) > room) return false;
    uint8_t at = ring.head;
    put_word(ring, frame.size, at);
    put_word(ring, frame.source, at);
    put_word(ring, frame.type, at);
    for (uint16_t i = 0; i < frame.size; ++i) put(ring, frame.payload[i], at);
    ring.head = at;
    return true;
}

void begin_frame(Sender& sender, SendRing& ring) {
    // A frame that is queued is shorter than the ring: the low byte of its size says it all.
    sender.current = &ring;
    sender.left = static_cast<uint16_t>(wire::kHeaderSize + ring.bytes[ring.tail]);
}

}  // namespace

void queue(Sender& sender, const wire::Frame& frame) {
    const bool event = wire::is_user_event(frame.type);
    if (put_frame(event ? sender.events : sender.messages, frame)) return;
    ++(event ? sender.dropped_events : sender.dropped_messages);
}

bool has_room(const Sender& sender, uint8_t size) {
    return size <= kLast - waiting(sender.messages);
}

bool take_byte(Sender& sender, uint8_t& byte) {
    if (sender.left == 0) {
        if (waiting(sender.messages) > 0) {
            begin_frame(sender, sender.messages);
        } else if (waiting(sender.events) > 0) {
            begin_frame(sender, sender.events);
        } else {
            return false;
        }
    }
    SendRing& ring = *sender.current;
    byte = ring.bytes[ring.tail];
    ring.tail = static_cast<uint8_t>(ring.tail + 1) & kLast;
    --sender.left;
    return true;
}

}  // namespace firmware
}  // namespace vagus
