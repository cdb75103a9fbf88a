// Encoded frames one behind the other, first in, first out: one lane of an output queue. Each has
// the number of its turn, by which the queue tells which of two lanes is older.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "wire/frame.hpp"

namespace vagus::hub {

inline size_t encoded_size_at(const uint8_t* frame) {
    return size_t{wire::kHeaderSize} + static_cast<size_t>(frame[0] | (frame[1] << 8));
}

class FrameLane {
public:
    void push(uint32_t turn, std::span<const uint8_t> encoded) {
        if (head_ >= kReclaimBytes && head_ >= buffer_.size() / 2) reclaim();
        const auto* const stamp = reinterpret_cast<const uint8_t*>(&turn);
        buffer_.insert(buffer_.end(), stamp, stamp + kStamp);
        buffer_.insert(buffer_.end(), encoded.begin(), encoded.end());
        bytes_ += encoded.size();
        ++frames_;
    }
    // Of the oldest; there must be one.
    uint32_t turn() const {
        assert(!empty());
        uint32_t turn = 0;
        std::memcpy(&turn, buffer_.data() + head_, kStamp);
        return turn;
    }
    // The oldest, borrowed until the next push() or drop_front().
    std::span<const uint8_t> front() const {
        assert(!empty());
        const uint8_t* const frame = buffer_.data() + head_ + kStamp;
        return {frame, encoded_size_at(frame)};
    }
    void drop_front() {
        const size_t size = front().size();
        head_ += kStamp + size;
        bytes_ -= size;
        --frames_;
        if (frames_ == 0) reclaim();
    }
    // Takes out what `goes` says of the encoded frame; how many there were.
    template <typename Goes>
    size_t erase_if(Goes goes) {
        FrameLane kept;
        const size_t before = frames_;
        for (; !empty(); drop_front()) {
            if (!goes(front())) kept.push(turn(), front());
        }
        *this = std::move(kept);
        return before - frames_;
    }
    bool empty() const { return frames_ == 0; }
    size_t frames() const { return frames_; }
    size_t bytes() const { return bytes_; }  // of the frames

private:
    static constexpr size_t kStamp = sizeof(uint32_t);
    static constexpr size_t kReclaimBytes = 64 * 1024;

    void reclaim() {
        buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<ptrdiff_t>(head_));
        head_ = 0;
    }

    std::vector<uint8_t> buffer_;  // stamp and frame, in turn
    size_t head_ = 0;
    size_t bytes_ = 0;
    size_t frames_ = 0;
};

}  // namespace vagus::hub
