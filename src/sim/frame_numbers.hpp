// Numbers of the frames of a world, and of what each was an answer to: so that a recording can tell
// why a frame was sent. Frames travel as bytes, without a number; whoever takes one finds it again
// by its bytes, the oldest first that he has not taken yet: senders are heard in their order.
//
//     FrameNumbers numbers;
//     const uint32_t number = numbers.sent(frame, cause);         // from 1 on
//     uint32_t last = 0;                                          // the receiver's
//     const uint32_t same = numbers.find(frame, last);            // 0: not one of these
//     const uint32_t why = numbers.cause_of(same);                // 0: no frame
//
// Of equal frames of which a bus has dropped one, the numbers may be those of their neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "wire/frame.hpp"

namespace vagus::sim {

constexpr size_t kFramesOnTheirWay = 65536;  // older ones are not found any more

class FrameNumbers {
public:
    // From one thread at a time.
    uint32_t sent(const wire::Frame& frame, uint32_t cause);
    // From several threads, while nobody sends.
    uint32_t find(const wire::Frame& frame, uint32_t after) const;
    uint32_t cause_of(uint32_t number) const;

private:
    static uint64_t key_of(const wire::Frame& frame);
    void forget();

    std::unordered_map<uint64_t, std::vector<uint32_t>> of_bytes_;
    std::vector<uint64_t> key_of_;  // by number - 1
    std::vector<uint32_t> causes_;  // by number - 1
    size_t forgotten_ = 0;          // the first so many are not in of_bytes_ any more
};

}  // namespace vagus::sim
