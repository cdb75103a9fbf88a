// The frames that wait to leave through one link. Bounded in frames and in bytes; what does not fit
// is dropped by the rule of docs/decisions/0050-what-a-full-queue-drops.md and counted.
//
// Messages get through floods: while more than kEventsAhead user events wait, every other message
// leaves before them (docs/decisions/0054-messages-pass-events.md). So a message may pass events,
// but never another message, and an event never passes another event. With fewer events all leave
// in the order in which they came. The notice that an event was killed counts as an event here: it
// comes as often as they do.
//
// Stop passes everything, and a full queue has room for it
// (docs/decisions/0056-stop-passes-everything.md). What waits for the same node and would act there
// is dropped, since it is older than Stop; what comes behind, as the writes that make a node safe,
// follows it at once, until the next command that lets the node act.
//
// Frames are copied in. A frame has at most 522 bytes, and copying them costs less than counting
// references to a shared one and naming it to the kernel piece by piece
// (docs/decisions/0051-frames-are-copied-into-queues.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "hub/frame_lane.hpp"
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
// While more events wait, messages pass them.
constexpr size_t kEventsAhead = 64;
// Stop, and what follows it, beyond all else.
constexpr size_t kUrgentBytesMax = 64 * 1024;
// What is handed to the kernel at once ends with the frame that reaches this size; nothing can pass
// it any more. On a serial line of 115,200 baud it takes 0.35 s.
constexpr size_t kBatchBytes = 4096;

struct Dropped {
    uint64_t events = 0;    // user events
    uint64_t messages = 0;  // everything else: commands, requests, replies, unknown types
    bool operator==(const Dropped&) const = default;
};

class OutputQueue {
public:
    // Appends one encoded frame (header and payload, as wire::encode() writes it), or drops
    // something and counts it. False: a Stop for a node that has one waiting, which is that one.
    bool push(std::span<const uint8_t> encoded);

    // The next bytes to write, empty if nothing waits: the same until sent() has taken them all.
    // Borrowed until the next push(), pop() or sent().
    std::span<const uint8_t> batch();
    // The first `count` of the last batch() have left.
    void sent(size_t count);
    // Takes the next frame; false if there is none. Not for a queue that gives batches.
    bool pop(wire::Frame& frame);

    bool empty() const { return bytes() == 0; }
    size_t bytes() const {
        return events_.bytes() + messages_.bytes() + urgent_.bytes() + batch_.size() - sent_;
    }
    // A frame of which a part has left counts.
    size_t frames() const { return waiting() + batch_frames_; }
    const Dropped& dropped() const { return dropped_; }

private:
    size_t waiting() const { return events_.frames() + messages_.frames() + urgent_.frames(); }
    // True: it follows a Stop that waits, and is in its lane. What lets the node act ends that.
    bool follow_stop(uint16_t type, std::span<const uint8_t> encoded);
    bool push_stop(uint16_t node, std::span<const uint8_t> encoded);
    bool fits(size_t size) const;
    bool make_room(size_t size, size_t events_needed);
    void drop_oldest_events();
    FrameLane& next();
    void drop_front(FrameLane& lane);

    FrameLane events_;
    FrameLane messages_;
    FrameLane urgent_;
    std::set<uint16_t> stopping_;  // nodes whose commands follow a Stop that waits
    uint32_t turn_ = 0;
    std::vector<uint8_t> batch_;
    size_t sent_ = 0;          // of the batch
    size_t batch_whole_ = 0;   // the first frame of the batch of which a part is still there
    size_t batch_frames_ = 0;  // from there on
    Dropped dropped_;
};

}  // namespace vagus::hub
