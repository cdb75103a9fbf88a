#include "firmware/node/receiver.hpp"

#include "firmware/board.hpp"

namespace vagus {
namespace firmware {

namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "words of a frame are read where they lie");

using wire::kHeaderSize;

// Types of section 2 are the first few of each range.
constexpr uint16_t kTypeNumberBits = 0x001f;
constexpr uint16_t kBootloader = 0x8000;
constexpr uint16_t kNodeMessages = 0x9000;

// What most events are: of 32 arguments at most, of a node that a CAN bus can name (section 1.6),
// with a number that a script can emit (section 3.4).
constexpr uint16_t kLikelySize = 64;
constexpr uint16_t kLikelySource = 256;
constexpr uint16_t kLikelyType = 4096;

enum class Verdict : uint8_t { Frame, Wait, Wrong };

// Of a header, which may begin at an odd place.
uint16_t word_at(const uint8_t* bytes) {
    return static_cast<uint16_t>(bytes[0] | (bytes[1] << 8));
}
uint16_t size_of(const uint8_t* header) {
    return word_at(header);
}
uint16_t source_of(const uint8_t* header) {
    return word_at(header + 2);
}
uint16_t type_of(const uint8_t* header) {
    return word_at(header + 4);
}

// Bytes of a command, read one place too early or too late, look like an event of a strange node;
// six zeros are inside of many frames.
bool is_likely(const uint8_t* header) {
    const uint16_t size = size_of(header);
    const uint16_t source = source_of(header);
    const uint16_t type = type_of(header);
    if (wire::is_user_event(type)) {
        return size <= kLikelySize && size % 2 == 0 && source < kLikelySource &&
               type < kLikelyType && (size | source | type) != 0;
    }
    if (size > wire::kPayloadMax || source == wire::kInvalidId) return false;
    const uint16_t range = static_cast<uint16_t>(type & ~kTypeNumberBits);
    const bool from_host = source == wire::kHostId;
    return range == kBootloader ||
           (from_host ? range == kCommands && size >= 2 : range == kNodeMessages);
}

bool needs_witness(const uint8_t* header, bool doubt) {
    return doubt || !is_likely(header) ||
           type_of(header) == static_cast<uint16_t>(wire::MessageType::SetBytecode);
}

// Is there a frame at the front? `quiet_ms` since the last byte.
Verdict judge(const Receiver& receiver, uint16_t have, uint16_t quiet_ms, uint16_t frame_ms) {
    const bool doubt = receiver.doubt;
    const bool more_may_come =
        quiet_ms < (doubt ? kWitness_ms : kBroken_ms) && frame_ms < kFrameWithin_ms;
    const Verdict unfinished = more_may_come ? Verdict::Wait : Verdict::Wrong;
    if (have < kHeaderSize) return unfinished;
    const uint8_t* const header = reinterpret_cast<const uint8_t*>(receiver.row) + receiver.begin;
    if (size_of(header) > wire::kPayloadMax || (doubt && !is_likely(header))) return Verdict::Wrong;
    const uint16_t size = static_cast<uint16_t>(kHeaderSize + size_of(header));
    if (have < size) return unfinished;
    if (!needs_witness(header, doubt)) return Verdict::Frame;
    if (have >= size + kHeaderSize) {
        return is_likely(header + size) ? Verdict::Frame : Verdict::Wrong;
    }
    return have == size && quiet_ms >= kWitness_ms ? Verdict::Frame : unfinished;
}

// Moves what waits to the begin of the row. Bytes may come meanwhile.
void move_up(Receiver& receiver) {
    uint8_t* bytes = reinterpret_cast<uint8_t*>(receiver.row);
    for (uint16_t moved = 0;; ++moved) {
        const uint8_t before = board::hold();
        const uint16_t from = static_cast<uint16_t>(receiver.begin + moved);
        if (from == receiver.end.in_interrupt()) {
            receiver.begin = 0;
            receiver.end.in_interrupt(moved);
            receiver.seen = moved;
            return board::release(before);
        }
        board::release(before);
        bytes[moved] = bytes[from];
    }
}

}  // namespace

void receive_byte(Receiver& receiver, uint8_t byte) {
    const uint16_t end = receiver.end.in_interrupt();
    if (end == kReceiveRoom) {
        const uint16_t lost = receiver.lost.in_interrupt();
        receiver.lost.in_interrupt(static_cast<uint16_t>(lost + 1));
        return;
    }
    reinterpret_cast<uint8_t*>(receiver.row)[end] = byte;
    receiver.end.in_interrupt(static_cast<uint16_t>(end + 1));
}

[[gnu::noinline]] bool next_frame(Receiver& receiver, uint16_t now_ms) {
    for (;;) {
        const uint16_t end = receiver.end.load();
        if (end != receiver.seen) {
            receiver.seen = end;
            receiver.seen_ms = now_ms;
        }
        const uint16_t quiet_ms = static_cast<uint16_t>(now_ms - receiver.seen_ms);
        const uint16_t have = static_cast<uint16_t>(end - receiver.begin);
        if (have == 0) {
            receiver.began_ms = now_ms;
            // Behind a silence a frame begins, whatever was before.
            if (quiet_ms >= kWitness_ms) receiver.doubt = false;
        }
        const uint16_t frame_ms = static_cast<uint16_t>(now_ms - receiver.began_ms);
        const Verdict verdict =
            have == 0 ? Verdict::Wait : judge(receiver, have, quiet_ms, frame_ms);
        if (verdict != Verdict::Wrong) {
            if (receiver.begin > 0) move_up(receiver);
            return verdict == Verdict::Frame;
        }
        receiver.doubt = true;
        receiver.began_ms = now_ms;
        ++receiver.begin;
        ++receiver.skipped;
    }
}

Received front(const Receiver& receiver) {
    const uint16_t* row = receiver.row;
    return {row[1], row[2], row + 3, static_cast<uint16_t>(row[0] / 2)};
}

void drop_front(Receiver& receiver, uint16_t now_ms) {
    receiver.begin = static_cast<uint16_t>(kHeaderSize + receiver.row[0]);
    receiver.began_ms = now_ms;
    receiver.doubt = false;
}

}  // namespace firmware
}  // namespace vagus
