#include "firmware/node/receiver.hpp"

#include "firmware/board.hpp"

namespace vagus {
namespace firmware {

namespace {

using wire::kHeaderSize;

// Types of section 2 are the first few of each range: 0x8000, 0x9000, 0xa000.
constexpr uint16_t kTypeNumberBits = 0x001f;
constexpr uint16_t kCommands = 0xa000;

// What most events are: of 32 arguments at most, of a node that a CAN bus can name (section 1.6),
// with a number that a script can emit (section 3.4).
constexpr uint16_t kLikelySize = 64;
constexpr uint16_t kLikelySource = 256;
constexpr uint16_t kLikelyType = 4096;

enum class Verdict : uint8_t { Frame, Wait, Wrong };

// The bytes that wait, seen as a row.
struct Row {
    const uint8_t* ring;
    uint16_t first;
    uint16_t have;

    uint8_t byte(uint16_t at) const {
        const uint16_t place = static_cast<uint16_t>(first + at);
        return ring[place < kReceiveRoom ? place : place - kReceiveRoom];
    }
    uint16_t word(uint16_t at) const {
        return static_cast<uint16_t>(byte(at) | (byte(static_cast<uint16_t>(at + 1)) << 8));
    }
    uint16_t size(uint16_t at) const { return word(at); }
    uint16_t source(uint16_t at) const { return word(static_cast<uint16_t>(at + 2)); }
    uint16_t type(uint16_t at) const { return word(static_cast<uint16_t>(at + 4)); }
};

// Two bytes are read together: the interrupt must not come in between on an 8-bit processor.
Row row_of(const Receiver& receiver) {
    const uint8_t before = board::hold();
    const uint16_t head = receiver.head;
    board::release(before);
    const uint16_t tail = receiver.tail;
    const uint16_t have =
        static_cast<uint16_t>(head >= tail ? head - tail : head + kReceiveRoom - tail);
    return {receiver.ring, tail, have};
}

void drop(Receiver& receiver, uint16_t count) {
    uint16_t tail = static_cast<uint16_t>(receiver.tail + count);
    if (tail >= kReceiveRoom) tail = static_cast<uint16_t>(tail - kReceiveRoom);
    const uint8_t before = board::hold();
    receiver.tail = tail;
    board::release(before);
}

// Six zeros: event 0 of a host without arguments, and what stands inside of many a frame.
bool is_zero(const Row& row, uint16_t at) {
    return (row.size(at) | row.source(at) | row.type(at)) == 0;
}

bool is_possible(const Row& row, uint16_t at) {
    const uint16_t size = row.size(at);
    const uint16_t source = row.source(at);
    const uint16_t type = row.type(at);
    if (size > wire::kPayloadMax || source == wire::kInvalidId) return false;
    if (wire::is_user_event(type)) return size % 2 == 0;
    const uint16_t range = static_cast<uint16_t>(type & ~kTypeNumberBits);
    if (range == kCommands) return size >= 2 && source == wire::kHostId;
    return range == 0x8000 || (range == 0x9000 && source != wire::kHostId);
}

// Not only possible: bytes of a command, read one place too early or too late, look like an event
// of a strange node.
bool is_likely(const Row& row, uint16_t at) {
    if (!is_possible(row, at) || is_zero(row, at)) return false;
    return !wire::is_user_event(row.type(at)) ||
           (row.size(at) <= kLikelySize && row.source(at) < kLikelySource &&
            row.type(at) < kLikelyType);
}

bool is_bytecode(const Row& row) {
    return row.type(0) == static_cast<uint16_t>(wire::MessageType::SetBytecode);
}

bool needs_witness(const Row& row) {
    return !is_likely(row, 0) || is_bytecode(row);
}

struct Waited {
    uint32_t quiet_ms;  // since the last byte
    uint16_t frame_ms;  // since the frame came to the front
};

// Is there a frame at the front?
Verdict judge(const Row& row, bool doubt, Waited waited) {
    const bool more_may_come =
        waited.quiet_ms < (doubt ? kWitness_ms : kBroken_ms) && waited.frame_ms < kFrameWithin_ms;
    if (row.have < kHeaderSize) return more_may_come ? Verdict::Wait : Verdict::Wrong;
    if (doubt ? !is_likely(row, 0) : !is_possible(row, 0)) return Verdict::Wrong;
    const uint16_t end = static_cast<uint16_t>(kHeaderSize + row.size(0));
    if (row.have >= end && !doubt && !needs_witness(row)) return Verdict::Frame;
    if (row.have >= end + kHeaderSize) return is_likely(row, end) ? Verdict::Frame : Verdict::Wrong;
    if (row.have == end && waited.quiet_ms >= kWitness_ms) return Verdict::Frame;
    return more_may_come ? Verdict::Wait : Verdict::Wrong;
}

// Also one to all nodes.
bool is_command_to(const Row& row, uint16_t node) {
    const uint16_t type = row.type(0);
    if (node == kNobody || type < kCommands) return false;
    return type == static_cast<uint16_t>(wire::MessageType::GetDescription) ||
           type == static_cast<uint16_t>(wire::MessageType::ListNodes) ||
           row.word(kHeaderSize) == node;
}

void copy(const Row& row, Received& frame) {
    frame.source = row.source(0);
    frame.type = row.type(0);
    frame.count = static_cast<uint16_t>(row.size(0) / 2);
    for (uint16_t i = 0; i < frame.count; ++i) {
        frame.words[i] = row.word(static_cast<uint16_t>(kHeaderSize + 2 * i));
    }
}

}  // namespace

void receive_byte(Receiver& receiver, uint8_t byte) {
    const uint16_t head = receiver.head;
    const uint16_t next = static_cast<uint16_t>(head + 1 == kReceiveRoom ? 0 : head + 1);
    if (next == receiver.tail) {
        receiver.lost = static_cast<uint16_t>(receiver.lost + 1);
        return;
    }
    receiver.ring[head] = byte;
    receiver.head = next;
}

bool next_frame(Receiver& receiver, uint32_t now_ms, uint16_t busy, Received& frame) {
    for (;;) {
        const Row row = row_of(receiver);
        const uint16_t head = static_cast<uint16_t>(row.first + row.have);
        if (head % kReceiveRoom != receiver.seen) {
            receiver.seen = head % kReceiveRoom;
            receiver.last_ms = now_ms;
        }
        const uint32_t quiet_ms = now_ms - receiver.last_ms;
        if (row.have == 0) {
            // Behind a silence a frame begins, whatever was before.
            if (quiet_ms >= kWitness_ms) receiver.doubt = false;
            receiver.began_ms = static_cast<uint16_t>(now_ms);
            return false;
        }
        const uint16_t frame_ms = static_cast<uint16_t>(now_ms - receiver.began_ms);
        const Verdict verdict = judge(row, receiver.doubt, {quiet_ms, frame_ms});
        if (verdict == Verdict::Wait) return false;
        if (verdict == Verdict::Frame && is_command_to(row, busy)) return false;
        receiver.doubt = verdict == Verdict::Wrong;
        receiver.began_ms = static_cast<uint16_t>(now_ms);
        if (verdict == Verdict::Frame) {
            copy(row, frame);
            drop(receiver, static_cast<uint16_t>(kHeaderSize + row.size(0)));
            return true;
        }
        drop(receiver, 1);
        ++receiver.skipped;
    }
}

}  // namespace firmware
}  // namespace vagus
