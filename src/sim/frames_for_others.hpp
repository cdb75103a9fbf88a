// The frames on a bus that a node must not take, because a host says them to another robot. They
// travel as any other frame, and are known by their bytes (docs/decisions/0094).
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <vector>

#include "wire/frame.hpp"

namespace vagus::sim {

// More than a queue of the bus holds are never on their way; of more the oldest are forgotten.
constexpr size_t kFramesForOthersMax = 4096;

class FramesForOthers {
public:
    void add(const wire::Frame& frame) {
        if (frames_.size() >= kFramesForOthersMax) frames_.pop_front();
        frames_.push_back(bytes_of(frame));
    }

    // Whether the frame that has arrived is one of them, each once.
    bool take(const wire::Frame& frame) {
        if (frames_.empty()) return false;
        const auto found = std::find(frames_.begin(), frames_.end(), bytes_of(frame));
        if (found == frames_.end()) return false;
        frames_.erase(found);
        return true;
    }

    void clear() { frames_.clear(); }

private:
    static std::vector<uint8_t> bytes_of(const wire::Frame& frame) {
        std::array<uint8_t, wire::kFrameMax> bytes;
        const uint16_t size = wire::encode(frame, bytes.data());
        return {bytes.begin(), bytes.begin() + size};
    }

    std::deque<std::vector<uint8_t>> frames_;
};

}  // namespace vagus::sim
