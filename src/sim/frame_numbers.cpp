#include "sim/frame_numbers.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace vagus::sim {

namespace {

constexpr uint64_t kNoFrame = 0;

}  // namespace

// FNV-1a of 64 bits: two frames that are on their way at once and differ do not share it.
uint64_t FrameNumbers::key_of(const FrameOnBus& one) {
    constexpr uint64_t kPrime = 0x100000001b3u;
    std::array<uint8_t, wire::kFrameMax> bytes;
    const uint16_t size = wire::encode(one.frame, bytes.data());
    uint64_t key = (0xcbf29ce484222325u ^ one.bus) * kPrime;
    for (uint16_t i = 0; i < size; ++i) key = (key ^ bytes[i]) * kPrime;
    return key;
}

uint32_t FrameNumbers::add(uint64_t key, uint32_t cause) {
    key_of_.push_back(key);
    causes_.push_back(cause);
    return static_cast<uint32_t>(causes_.size());
}

uint32_t FrameNumbers::sent(const FrameOnBus& one, uint32_t cause) {
    const uint64_t key = key_of(one);
    const uint32_t number = add(key, cause);
    of_bytes_[key].push_back(number);
    if (causes_.size() - forgotten_ > kFramesOnTheirWay) forget();
    return number;
}

uint32_t FrameNumbers::other(uint32_t cause) {
    return add(kNoFrame, cause);
}

void FrameNumbers::forget() {
    const auto found = of_bytes_.find(key_of_[forgotten_++]);
    if (found == of_bytes_.end()) return;  // it was no frame
    std::vector<uint32_t>& numbers = found->second;
    numbers.erase(numbers.begin());
    if (numbers.empty()) of_bytes_.erase(found);
}

uint32_t FrameNumbers::find(const FrameOnBus& one, uint32_t after) const {
    const auto found = of_bytes_.find(key_of(one));
    if (found == of_bytes_.end()) return 0;
    const auto next = std::upper_bound(found->second.begin(), found->second.end(), after);
    return next == found->second.end() ? 0 : *next;
}

uint32_t FrameNumbers::cause_of(uint32_t number) const {
    return number == 0 || number > causes_.size() ? 0 : causes_[number - 1];
}

}  // namespace vagus::sim
