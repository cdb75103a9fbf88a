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
#include <vector>

#include "wire/frame.hpp"

namespace vagus::sim {

constexpr size_t kFramesOnTheirWay = 65536;  // older ones are not found any more
// Of equal frames; who has taken none of the newest so many takes the oldest of these.
constexpr size_t kEqualFramesMax = 1024;

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
    struct Sent {
        uint64_t key = 0;
        uint32_t cause = 0;
        uint32_t before = 0;  // the number of the last one with the same bytes; 0: there was none
    };
    static uint64_t key_of(const FrameOnBus& one);
    size_t home_of(uint64_t key) const;
    size_t place_of(uint64_t key) const;
    size_t after(size_t place) const { return (place + 1) & (newest_.size() - 1); }
    void grow();
    void empty(size_t place);
    void forget();

    std::vector<Sent> sent_;        // by number - 1
    std::vector<uint32_t> newest_;  // numbers, by key; 0: that place is empty
    size_t keys_ = 0;               // places that are not
    size_t forgotten_ = 0;          // the first so many are not found any more
};

}  // namespace vagus::sim
