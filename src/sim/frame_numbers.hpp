// Numbers of the frames of a world, and of what each was an answer to: so that a recording can tell
// why a frame was sent. Frames travel as bytes, without a number; whoever takes one finds it again
// by its bytes, the oldest first that he has not taken yet: senders are heard in their order.
//
//     FrameNumbers numbers;
//     const uint32_t number = numbers.sent({frame, bus}, cause);  // from 1 on
//     uint32_t last = 0;                                          // the receiver's
//     const uint32_t same = numbers.find({frame, bus}, last);     // 0: not one of these
//     const uint32_t why = numbers.cause_of(same);                // 0: no frame
//
// Several buses count together, so that a number says which frame of which bus it is; each frame is
// found on its own bus alone.
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

// A frame on one of the buses of a world: 0 is the common one, else that of the robot with this
// number.
struct FrameOnBus {
    const wire::Frame& frame;
    uint32_t bus = 0;
};

class FrameNumbers {
public:
    // From one thread at a time.
    uint32_t sent(const FrameOnBus& one, uint32_t cause);
    // The number of something that is no frame, and that frames follow from: what came over a
    // fleet.
    uint32_t other(uint32_t cause);
    // From several threads, while nobody sends.
    uint32_t find(const FrameOnBus& one, uint32_t after) const;
    uint32_t cause_of(uint32_t number) const;

private:
    static uint64_t key_of(const FrameOnBus& one);
    uint32_t add(uint64_t key, uint32_t cause);
    void forget();

    std::unordered_map<uint64_t, std::vector<uint32_t>> of_bytes_;
    std::vector<uint64_t> key_of_;  // by number - 1
    std::vector<uint32_t> causes_;  // by number - 1
    size_t forgotten_ = 0;          // the first so many are not in of_bytes_ any more
};

}  // namespace vagus::sim
