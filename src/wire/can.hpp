// Frames on a CAN bus (docs/spec/aseba-wire-and-vm.md, section 1.6). The inner packet (type and
// payload, up to 518 bytes) is cut into CAN frames of at most 8 bytes:
//
//     identifier bits 10..8   3 Small: a whole packet | 1 Start | 0 Normal: a middle part | 2 Stop
//     identifier bits  7..0   source
//
// Fragments of different sources may interleave; one source never interleaves its own packets. The
// bus itself checks and repeats, so there are no numbers and no acknowledgements.
//
//     CanFrame parts[kCanFramesMax];
//     const uint8_t count = can_fragment(frame, parts);      // 0: the source does not fit
//
//     CanReassembler<64> incoming;
//     incoming.put(can_frame);
//     Frame frame;
//     while (incoming.take(frame)) use(frame);
#pragma once

#include <stdint.h>

#include "wire/frame.hpp"

namespace vagus {
namespace wire {

constexpr uint16_t kCanSourceMax = 255;  // an identifier has 8 bits for it
constexpr uint8_t kCanBytesMax = 8;
constexpr uint8_t kCanFramesMax =
    (kPayloadMax + 2 + kCanBytesMax - 1) / kCanBytesMax;  // of a packet: 65

enum class CanPart : uint8_t { Normal = 0, Start = 1, Stop = 2, Small = 3 };

struct CanFrame {
    uint16_t identifier;  // 11 bits
    uint8_t size;         // at most kCanBytesMax
    uint8_t bytes[kCanBytesMax];

    uint8_t source() const { return static_cast<uint8_t>(identifier & 0xff); }
    // The values 4 to 7 belong to nobody.
    uint8_t part() const { return static_cast<uint8_t>((identifier >> 8) & 7); }
};

// Fills `parts`, which has room for kCanFramesMax; gives their number. 0 if the source is above
// kCanSourceMax: such an id would turn into another part and another source.
[[gnu::warn_unused_result]] uint8_t can_fragment(const Frame& frame, CanFrame* parts);

// What put() did with a frame.
enum class CanPut : uint8_t {
    Stored,
    Ignored,   // no part of a packet: identifier above 11 bits, part 4 to 7, more than 8 bytes
    Orphan,    // a middle or an end whose beginning was lost: the whole packet is
    Overflow,  // no room: the frame is lost, and what came of its packet before
};

// Puts packets together again. The storage is that of CanReassembler below. One frame of the
// storage stays free, as in the reference. Unlike there a packet that lost any part is lost as a
// whole, never given with a hole in it.
class CanQueue {
public:
    CanQueue(CanFrame* storage, uint16_t capacity)
        : frames_(storage), capacity_(capacity), count_(0), lost_(0), broken_() {}

    CanPut put(const CanFrame& frame);
    // Takes the oldest whole packet; false if there is none.
    bool take(Frame& frame);
    // CAN frames that came and did not become part of a packet, ignored ones left out.
    uint32_t lost() const { return lost_; }
    uint16_t waiting() const { return count_; }

private:
    CanPut put_part(const CanFrame& frame);
    CanPut lose(const CanFrame& frame, CanPut why);
    uint16_t open_packet(uint8_t source) const;
    void remove_open_packet(uint8_t source);
    void remove_at(uint16_t index);
    bool gather(uint16_t last, Frame& frame);
    bool is_broken(uint8_t source) const { return (broken_[source / 8] >> (source % 8)) & 1; }
    void set_broken(uint8_t source);
    void clear_broken(uint8_t source);

    CanFrame* frames_;  // oldest first; every Stop in it has its Start
    uint16_t capacity_;
    uint16_t count_;
    uint32_t lost_;
    uint8_t
        broken_[32];  // a bit for each source: what comes before its next Start or Small is lost
};

template <uint16_t kCapacity>
class CanReassembler : public CanQueue {
public:
    CanReassembler() : CanQueue(storage_, kCapacity) {}
    CanReassembler(const CanReassembler&) = delete;
    CanReassembler& operator=(const CanReassembler&) = delete;

private:
    CanFrame storage_[kCapacity];
};

}  // namespace wire
}  // namespace vagus
