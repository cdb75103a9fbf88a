#include "sim/frame_numbers.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace vagus::sim {

namespace {

constexpr uint64_t kNoFrame = 0;
constexpr size_t kNewestMin = 256;  // places; a power of two, as all their numbers

}  // namespace

// FNV-1a with eight bytes at a time, whose upper half is mixed into the lower one: two frames that
// are on their way at once and differ do not share it.
uint64_t FrameNumbers::key_of(const FrameOnBus& one) {
    constexpr uint64_t kPrime = 0x100000001b3u;
    constexpr int kUpperBits = 32;
    uint64_t key = 0xcbf29ce484222325u;
    const auto mix = [&key](uint64_t bytes) {
        key = (key ^ bytes) * kPrime;
        key ^= key >> kUpperBits;
    };
    const wire::Frame& frame = one.frame;
    mix(uint64_t{one.bus} << 32 | uint64_t{frame.source} << 16 | frame.type);
    mix(frame.size);
    for (size_t at = 0; at < frame.size;) {
        uint64_t bytes = 0;
        const size_t count = std::min(sizeof bytes, frame.size - at);
        std::memcpy(&bytes, frame.payload + at, count);
        mix(bytes);
        at += count;
    }
    return key == kNoFrame ? 1 : key;
}

// ---- the newest frame of each key: open addressing, the next place where one is taken ----

size_t FrameNumbers::home_of(uint64_t key) const {
    return key & (newest_.size() - 1);
}

// Where its newest frame is, or would be.
size_t FrameNumbers::place_of(uint64_t key) const {
    size_t place = home_of(key);
    while (newest_[place] != 0 && sent_[newest_[place] - 1].key != key) place = after(place);
    return place;
}

void FrameNumbers::grow() {
    const std::vector<uint32_t> before =
        std::exchange(newest_, std::vector<uint32_t>(std::max(kNewestMin, 2 * newest_.size())));
    for (const uint32_t number : before) {
        if (number != 0) newest_[place_of(sent_[number - 1].key)] = number;
    }
}

// Those behind it move up, as far as they may.
void FrameNumbers::empty(size_t place) {
    newest_[place] = 0;
    --keys_;
    for (size_t next = after(place); newest_[next] != 0; next = after(next)) {
        const size_t home = home_of(sent_[newest_[next] - 1].key);
        const bool stays =
            place < next ? place < home && home <= next : place < home || home <= next;
        if (stays) continue;
        newest_[place] = std::exchange(newest_[next], 0);
        place = next;
    }
}

// ---- frames ----

uint32_t FrameNumbers::sent(const FrameOnBus& one, uint32_t cause) {
    if (2 * keys_ >= newest_.size()) grow();
    const uint64_t key = key_of(one);
    uint32_t& newest = newest_[place_of(key)];
    if (newest == 0) ++keys_;
    sent_.push_back({key, cause, newest});
    newest = static_cast<uint32_t>(sent_.size());
    const uint32_t number = newest;
    if (sent_.size() - forgotten_ > kFramesOnTheirWay) forget();
    return number;
}

uint32_t FrameNumbers::other(uint32_t cause) {
    sent_.push_back({kNoFrame, cause, 0});
    return static_cast<uint32_t>(sent_.size());
}

// The oldest. Newer ones of its key do not lead to it any more (find()).
void FrameNumbers::forget() {
    const auto number = static_cast<uint32_t>(++forgotten_);
    const uint64_t key = sent_[number - 1].key;
    if (key == kNoFrame) return;
    const size_t place = place_of(key);
    if (newest_[place] == number) empty(place);
}

uint32_t FrameNumbers::find(const FrameOnBus& one, uint32_t after) const {
    if (newest_.empty()) return 0;
    const auto too_old = std::max(after, static_cast<uint32_t>(forgotten_));
    uint32_t found = newest_[place_of(key_of(one))];
    if (found <= too_old) return 0;
    // Whoever keeps up has few to go back.
    for (size_t i = 1; i < kEqualFramesMax && sent_[found - 1].before > too_old; ++i) {
        found = sent_[found - 1].before;
    }
    return found;
}

uint32_t FrameNumbers::cause_of(uint32_t number) const {
    return number == 0 || number > sent_.size() ? 0 : sent_[number - 1].cause;
}

}  // namespace vagus::sim
