// The frames that wait to leave through one link, as the bytes that will be written, in one piece:
// whoever owns the socket hands the whole batch to one system call. Bounded in frames and in bytes;
// what does not fit is dropped by the rule of docs/decisions/0050-what-a-full-queue-drops.md and
// counted.
//
// Frames are copied in. A frame has at most 522 bytes, and copying them costs less than counting
// references to a shared one and naming it to the kernel piece by piece
// (docs/decisions/0051-frames-are-copied-into-queues.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "wire/frame.hpp"

namespace vagus::hub {

constexpr size_t kQueueBytesMax = 256 * 1024;
constexpr size_t kQueueFramesMax = 16 * 1024;
// A full queue makes room in one pass for at least this much, so that a flood does not pay for a
// pass each frame.
constexpr size_t kDropBytesAtOnce = kQueueBytesMax / 8;
constexpr size_t kDropFramesAtOnce = kQueueFramesMax / 8;
// An event that finds the queue full with fewer events than this is itself dropped.
constexpr size_t kDropFramesMin = 64;

struct Dropped {
    uint64_t events = 0;    // user events
    uint64_t messages = 0;  // everything else: commands, requests, replies, unknown types
    bool operator==(const Dropped&) const = default;
};

class OutputQueue {
public:
    // Appends one encoded frame (header and payload, as wire::encode() writes it), or drops
    // something.
    void push(std::span<const uint8_t> encoded);

    // All bytes that wait, oldest first. Borrowed until the next push(), pop() or sent().
    std::span<const uint8_t> bytes() const {
        return {buffer_.data() + head_, buffer_.size() - head_};
    }
    // The first `count` of bytes() have left. Any number: the rest of a frame that has begun is
    // never dropped.
    void sent(size_t count);
    // Takes the oldest frame; false if there is none. Not for a queue whose sent() cuts frames.
    bool pop(wire::Frame& frame);

    bool empty() const { return head_ == buffer_.size(); }
    // A frame of which a part has left counts.
    size_t frames() const { return whole_frames_ + (whole_ > head_ ? 1 : 0); }
    const Dropped& dropped() const { return dropped_; }

private:
    bool fits(size_t size) const;
    bool make_room_for(std::span<const uint8_t> encoded);
    void drop_oldest_events();
    void reclaim();

    std::vector<uint8_t> buffer_;
    size_t head_ = 0;   // first byte that has not left
    size_t whole_ = 0;  // first frame of which nothing has left
    size_t whole_frames_ = 0;
    size_t whole_events_ = 0;  // user events among them
    Dropped dropped_;
};

}  // namespace vagus::hub
