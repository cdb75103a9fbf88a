#include "wire/can.hpp"

#include <string.h>

namespace vagus {
namespace wire {

namespace {

constexpr uint16_t kInnerHeader = 2;  // the type
constexpr uint16_t kInnerMax = kInnerHeader + kPayloadMax;

bool is_part(const CanFrame& frame, CanPart part) {
    return frame.part() == static_cast<uint8_t>(part);
}

CanPart part_at(uint16_t offset, uint16_t size) {
    if (size <= kCanBytesMax) return CanPart::Small;
    if (offset == 0) return CanPart::Start;
    return size - offset > kCanBytesMax ? CanPart::Normal : CanPart::Stop;
}

}  // namespace

uint8_t can_fragment(const Frame& frame, CanFrame* parts) {
    if (frame.source > kCanSourceMax) return 0;
    uint8_t inner[kInnerMax];
    inner[0] = static_cast<uint8_t>(frame.type & 0xff);
    inner[1] = static_cast<uint8_t>(frame.type >> 8);
    memcpy(inner + kInnerHeader, frame.payload, frame.size);
    const uint16_t size = static_cast<uint16_t>(kInnerHeader + frame.size);

    uint8_t count = 0;
    for (uint16_t offset = 0; offset < size;
         offset = static_cast<uint16_t>(offset + kCanBytesMax)) {
        CanFrame& part = parts[count++];
        const uint16_t left = static_cast<uint16_t>(size - offset);
        part.identifier = static_cast<uint16_t>((static_cast<uint8_t>(part_at(offset, size)) << 8) |
                                                frame.source);
        part.size = left < kCanBytesMax ? static_cast<uint8_t>(left) : kCanBytesMax;
        memcpy(part.bytes, inner + offset, part.size);
    }
    return count;
}

CanPut CanQueue::put(const CanFrame& frame) {
    if (frame.identifier > 0x7ff || frame.part() > static_cast<uint8_t>(CanPart::Small) ||
        frame.size > kCanBytesMax) {
        return CanPut::Ignored;
    }
    if (is_part(frame, CanPart::Start)) remove_open_packet(frame.source());  // its Stop was lost
    if (is_part(frame, CanPart::Start) || is_part(frame, CanPart::Small)) {
        clear_broken(frame.source());
    }
    return put_part(frame);
}

CanPut CanQueue::put_part(const CanFrame& frame) {
    if (is_part(frame, CanPart::Normal) || is_part(frame, CanPart::Stop)) {
        const uint16_t before = open_packet(frame.source());
        if (before == 0 || is_broken(frame.source())) return lose(frame, CanPut::Orphan);
        const uint16_t rest = is_part(frame, CanPart::Stop) ? 0 : 1;
        if (before + 1 + rest > kCanFramesMax) return lose(frame, CanPut::Orphan);
    }
    if (capacity_ - count_ <= 1) return lose(frame, CanPut::Overflow);
    frames_[count_++] = frame;
    return CanPut::Stored;
}

// The frame is gone, so the packet that it belongs to is: what came of it and what will come.
CanPut CanQueue::lose(const CanFrame& frame, CanPut why) {
    ++lost_;
    if (is_part(frame, CanPart::Small)) return why;
    remove_open_packet(frame.source());
    if (is_part(frame, CanPart::Stop)) {
        clear_broken(frame.source());
    } else {
        set_broken(frame.source());
    }
    return why;
}

bool CanQueue::take(Frame& frame) {
    for (uint16_t i = 0; i < count_;) {
        if (!is_part(frames_[i], CanPart::Small) && !is_part(frames_[i], CanPart::Stop)) {
            ++i;
            continue;
        }
        if (gather(i, frame)) return true;
        i = 0;  // what was no packet has been removed
    }
    return false;
}

// The packet that ends at `last`: that frame alone if it is Small, else all frames of its source up
// to it, for what came before was taken before. They leave the queue in any case; false if they are
// too few or too many bytes.
bool CanQueue::gather(uint16_t last, Frame& frame) {
    const uint8_t source = frames_[last].source();
    const bool small = is_part(frames_[last], CanPart::Small);
    uint8_t inner[kCanFramesMax * kCanBytesMax];
    uint16_t size = 0;
    uint32_t used = 0;
    uint16_t at = small ? last : 0;
    for (uint16_t left = static_cast<uint16_t>(last + 1 - at); left > 0; --left) {
        if (frames_[at].source() != source) {
            ++at;
            continue;
        }
        memcpy(inner + size, frames_[at].bytes, frames_[at].size);
        size = static_cast<uint16_t>(size + frames_[at].size);
        remove_at(at);
        ++used;
    }
    if (size < kInnerHeader || size > kInnerMax) {
        lost_ += used;
        return false;
    }
    frame.source = source;
    frame.type = static_cast<uint16_t>(inner[0] | (inner[1] << 8));
    frame.size = static_cast<uint16_t>(size - kInnerHeader);
    memcpy(frame.payload, inner + kInnerHeader, frame.size);
    return true;
}

// How many frames of an unfinished packet of this source wait.
uint16_t CanQueue::open_packet(uint8_t source) const {
    uint16_t found = 0;
    for (uint16_t i = count_; i > 0; --i) {
        const CanFrame& frame = frames_[i - 1];
        if (frame.source() != source || is_part(frame, CanPart::Small)) continue;
        if (is_part(frame, CanPart::Stop)) return 0;
        ++found;
        if (is_part(frame, CanPart::Start)) return found;
    }
    return 0;
}

void CanQueue::remove_open_packet(uint8_t source) {
    uint16_t left = open_packet(source);
    for (uint16_t i = count_; left > 0 && i > 0; --i) {
        const CanFrame& frame = frames_[i - 1];
        if (frame.source() != source || is_part(frame, CanPart::Small)) continue;
        remove_at(static_cast<uint16_t>(i - 1));
        ++lost_;
        --left;
    }
}

void CanQueue::remove_at(uint16_t index) {
    --count_;
    memmove(frames_ + index, frames_ + index + 1,
            sizeof(CanFrame) * static_cast<size_t>(count_ - index));
}

void CanQueue::set_broken(uint8_t source) {
    broken_[source / 8] = static_cast<uint8_t>(broken_[source / 8] | (1 << (source % 8)));
}

void CanQueue::clear_broken(uint8_t source) {
    broken_[source / 8] = static_cast<uint8_t>(broken_[source / 8] & ~(1 << (source % 8)));
}

}  // namespace wire
}  // namespace vagus
