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

// Commands begin with the node that they are for.
uint16_t node_of(std::span<const uint8_t> encoded) {
    return encoded.size() < wire::kHeaderSize + 2 ? wire::kInvalidId
                                                  : word_at(encoded.data() + wire::kHeaderSize);
}

// Changes what the node does, or what it will do.
bool acts(uint16_t type) {
    switch (static_cast<wire::MessageType>(type)) {
        case wire::MessageType::SetBytecode:
        case wire::MessageType::Reset:
        case wire::MessageType::Run:
        case wire::MessageType::Step:
            return true;
        default:
            return false;
    }
}

}  // namespace

bool OutputQueue::follow_stop(uint16_t type, std::span<const uint8_t> encoded) {
    if (!wire::is_command(type)) return false;
    const auto stopping = stopping_.find(node_of(encoded));
    if (stopping == stopping_.end()) return false;
    if (acts(type)) {
        stopping_.erase(stopping);
        return false;
    }
    if (urgent_.bytes() + encoded.size() > kUrgentBytesMax) return false;
    urgent_.push(turn_++, encoded);
    return true;
}

// One Stop is enough until something follows that lets the node act.
bool OutputQueue::push_stop(uint16_t node, std::span<const uint8_t> encoded) {
    if (stopping_.contains(node)) return false;
    const auto set = static_cast<uint16_t>(wire::MessageType::SetVariables);
    dropped_.messages += messages_.erase_if([&](std::span<const uint8_t> waits) {
        const uint16_t type = word_at(waits.data() + 4);
        return wire::is_command(type) && node_of(waits) == node && (acts(type) || type == set);
    });
    if (urgent_.bytes() + encoded.size() > kUrgentBytesMax) {
        ++dropped_.messages;
        return true;
    }
    urgent_.push(turn_++, encoded);
    stopping_.insert(node);
    return true;
}

// Where few events wait, dropping frees little. An event is not worth that; a command or a reply
// is, and the next one then finds no events and is turned away at once.
bool OutputQueue::push(std::span<const uint8_t> encoded) {
    const uint16_t type = word_at(encoded.data() + 4);
    if (type == static_cast<uint16_t>(wire::MessageType::Stop))
        return push_stop(node_of(encoded), encoded);
    if (follow_stop(type, encoded)) return true;
    const bool event = is_event(encoded);
    if (fits(encoded.size()) || make_room(encoded.size(), event ? kDropFramesMin : 1))
        (event ? events_ : messages_).push(turn_++, encoded);
    else
        ++(event ? dropped_.events : dropped_.messages);
    return true;
}

// The lane whose oldest frame leaves next; one of them is not empty.
FrameLane& OutputQueue::next() {
    if (!urgent_.empty()) return urgent_;
    if (messages_.empty()) return events_;
    if (events_.empty() || events_.frames() > kEventsAhead) return messages_;
    // Turns wrap: what counts is which is behind the other.
    const auto ahead = static_cast<int32_t>(messages_.turn() - events_.turn());
    return ahead < 0 ? messages_ : events_;
}

void OutputQueue::drop_front(FrameLane& lane) {
    lane.drop_front();
    if (urgent_.empty()) stopping_.clear();
}

std::span<const uint8_t> OutputQueue::batch() {
    if (sent_ == batch_.size()) {
        batch_.clear();
        sent_ = batch_whole_ = batch_frames_ = 0;
        while (batch_.size() < kBatchBytes && waiting() > 0) {
            FrameLane& lane = next();
            const std::span<const uint8_t> frame = lane.front();
            batch_.insert(batch_.end(), frame.begin(), frame.end());
            drop_front(lane);
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
    drop_front(lane);
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
