#include "hub/output_queue.hpp"

#include <cassert>
#include <cstring>

namespace vagus::hub {

namespace {

uint16_t word_at(const uint8_t* bytes) {
    return static_cast<uint16_t>(bytes[0] | (bytes[1] << 8));
}
size_t frame_size_at(const uint8_t* frame) {
    return size_t{wire::kHeaderSize} + word_at(frame);
}
bool is_event_at(const uint8_t* frame) {
    return wire::is_user_event(word_at(frame + 4));
}

}  // namespace

void OutputQueue::push(std::span<const uint8_t> encoded) {
    const bool event = is_event_at(encoded.data());
    if (!fits(encoded.size()) && !make_room_for(encoded)) {
        ++(event ? dropped_.events : dropped_.messages);
        return;
    }
    if (head_ >= kQueueBytesMax) reclaim();
    buffer_.insert(buffer_.end(), encoded.begin(), encoded.end());
    ++whole_frames_;
    if (event) ++whole_events_;
}

void OutputQueue::sent(size_t count) {
    assert(count <= buffer_.size() - head_);
    head_ += count;
    while (whole_ < head_) {
        const uint8_t* frame = buffer_.data() + whole_;
        --whole_frames_;
        if (is_event_at(frame)) --whole_events_;
        whole_ += frame_size_at(frame);
    }
    if (empty()) reclaim();
}

bool OutputQueue::pop(wire::Frame& frame) {
    if (empty()) return false;
    assert(whole_ == head_);
    const uint8_t* bytes = buffer_.data() + head_;
    frame.size = word_at(bytes);
    frame.source = word_at(bytes + 2);
    frame.type = word_at(bytes + 4);
    std::memcpy(frame.payload, bytes + wire::kHeaderSize, frame.size);
    sent(frame_size_at(bytes));
    return true;
}

bool OutputQueue::fits(size_t size) const {
    return buffer_.size() - head_ + size <= kQueueBytesMax && frames() < kQueueFramesMax;
}

// Where few events wait, a pass over the queue frees little. An event is not worth that; a command
// or a reply is, and the next one then finds no events and is turned away at once. So nobody can
// make every push cost a pass.
bool OutputQueue::make_room_for(std::span<const uint8_t> encoded) {
    const size_t events_needed = is_event_at(encoded.data()) ? kDropFramesMin : 1;
    if (whole_events_ < events_needed) return false;
    drop_oldest_events();
    return fits(encoded.size());
}

// before: begun | event A | reply B | event C | event D …     after: begun | reply B | event D …
void OutputQueue::drop_oldest_events() {
    uint8_t* const base = buffer_.data();
    size_t from = whole_;
    size_t to = whole_;
    size_t dropped = 0;
    while (dropped < kDropFramesAtOnce && from - to < kDropBytesAtOnce && whole_events_ > 0) {
        const size_t size = frame_size_at(base + from);
        if (is_event_at(base + from)) {
            ++dropped;
            --whole_events_;
        } else {
            std::memmove(base + to, base + from, size);
            to += size;
        }
        from += size;
    }
    buffer_.erase(buffer_.begin() + static_cast<ptrdiff_t>(to),
                  buffer_.begin() + static_cast<ptrdiff_t>(from));
    whole_frames_ -= dropped;
    dropped_.events += dropped;
}

void OutputQueue::reclaim() {
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<ptrdiff_t>(head_));
    whole_ -= head_;
    head_ = 0;
}

}  // namespace vagus::hub
