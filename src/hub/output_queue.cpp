#include "hub/output_queue.hpp"

#include <cassert>
#include <cstring>

#include "wire/protocol.hpp"

namespace vagus::hub {

namespace {

uint16_t word_at(const uint8_t* bytes) {
    return static_cast<uint16_t>(bytes[0] | (bytes[1] << 8));
}

// What comes in floods and is worth least when it is old.
bool is_event(std::span<const uint8_t> encoded) {
    const uint16_t type = word_at(encoded.data() + 4);
    return wire::is_user_event(type) ||
           type == static_cast<uint16_t>(wire::MessageType::EventExecutionKilled);
}

}  // namespace

// Where few events wait, dropping frees little. An event is not worth that; a command or a reply
// is, and the next one then finds no events and is turned away at once.
void OutputQueue::push(std::span<const uint8_t> encoded) {
    const bool event = is_event(encoded);
    if (!fits(encoded.size()) && !make_room(encoded.size(), event ? kDropFramesMin : 1)) {
        ++(event ? dropped_.events : dropped_.messages);
        return;
    }
    (event ? events_ : messages_).push(turn_++, encoded);
}

// The lane whose oldest frame leaves next; one of them is not empty.
FrameLane& OutputQueue::next() {
    if (messages_.empty()) return events_;
    if (events_.empty() || events_.frames() > kEventsAhead) return messages_;
    // Turns wrap: what counts is which is behind the other.
    const auto ahead = static_cast<int32_t>(messages_.turn() - events_.turn());
    return ahead < 0 ? messages_ : events_;
}

std::span<const uint8_t> OutputQueue::batch() {
    if (sent_ == batch_.size()) {
        batch_.clear();
        sent_ = batch_whole_ = batch_frames_ = 0;
        while (batch_.size() < kBatchBytes && events_.frames() + messages_.frames() > 0) {
            FrameLane& lane = next();
            const std::span<const uint8_t> frame = lane.front();
            batch_.insert(batch_.end(), frame.begin(), frame.end());
            lane.drop_front();
            ++batch_frames_;
        }
    }
    return {batch_.data() + sent_, batch_.size() - sent_};
}

void OutputQueue::sent(size_t count) {
    assert(count <= batch_.size() - sent_);
    sent_ += count;
    while (batch_frames_ > 0) {
        const size_t end = batch_whole_ + encoded_size_at(batch_.data() + batch_whole_);
        if (end > sent_) return;
        batch_whole_ = end;
        --batch_frames_;
    }
}

bool OutputQueue::pop(wire::Frame& frame) {
    assert(sent_ == batch_.size());
    if (empty()) return false;
    FrameLane& lane = next();
    const std::span<const uint8_t> bytes = lane.front();
    frame.size = word_at(bytes.data());
    frame.source = word_at(bytes.data() + 2);
    frame.type = word_at(bytes.data() + 4);
    std::memcpy(frame.payload, bytes.data() + wire::kHeaderSize, frame.size);
    lane.drop_front();
    return true;
}

bool OutputQueue::fits(size_t size) const {
    return bytes() + size <= kQueueBytesMax && frames() < kQueueFramesMax;
}

bool OutputQueue::make_room(size_t size, size_t events_needed) {
    if (events_.frames() < events_needed) return false;
    drop_oldest_events();
    return fits(size);
}

void OutputQueue::drop_oldest_events() {
    const size_t bytes_before = events_.bytes();
    for (size_t count = 0; count < kDropFramesAtOnce && !events_.empty(); ++count) {
        if (bytes_before - events_.bytes() >= kDropBytesAtOnce) return;
        events_.drop_front();
        ++dropped_.events;
    }
}

}  // namespace vagus::hub
