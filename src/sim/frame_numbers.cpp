#include "sim/frame_numbers.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace vagus::sim {

// FNV-1a of 64 bits: two frames that are on their way at once and differ do not share it.
uint64_t FrameNumbers::key_of(const wire::Frame& frame) {
    std::array<uint8_t, wire::kFrameMax> bytes;
    const uint16_t size = wire::encode(frame, bytes.data());
    uint64_t key = 0xcbf29ce484222325u;
    for (uint16_t i = 0; i < size; ++i) key = (key ^ bytes[i]) * 0x100000001b3u;
    return key;
}

uint32_t FrameNumbers::sent(const wire::Frame& frame, uint32_t cause) {
    const uint64_t key = key_of(frame);
    key_of_.push_back(key);
    causes_.push_back(cause);
    const auto number = static_cast<uint32_t>(causes_.size());
    of_bytes_[key].push_back(number);
    if (causes_.size() - forgotten_ > kFramesOnTheirWay) forget();
    return number;
}

void FrameNumbers::forget() {
    const auto found = of_bytes_.find(key_of_[forgotten_++]);
    std::vector<uint32_t>& numbers = found->second;
    numbers.erase(numbers.begin());
    if (numbers.empty()) of_bytes_.erase(found);
}

uint32_t FrameNumbers::find(const wire::Frame& frame, uint32_t after) const {
    const auto found = of_bytes_.find(key_of(frame));
    if (found == of_bytes_.end()) return 0;
    const auto next = std::upper_bound(found->second.begin(), found->second.end(), after);
    return next == found->second.end() ? 0 : *next;
}

uint32_t FrameNumbers::cause_of(uint32_t number) const {
    return number == 0 || number > causes_.size() ? 0 : causes_[number - 1];
}

}  // namespace vagus::sim
