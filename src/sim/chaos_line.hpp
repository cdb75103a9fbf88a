// One direction of a link that faults act on: frames go in, and those that are not lost come out,
// perhaps twice, later, or past each other.
//
//     ChaosLine line;
//     line.begin(fault, 7);                        // the fault acts from now on
//     line.put(frame, now);
//     while (line.take(frame, now)) deliver(frame);
//     line.end(fault);
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "sim/chaos.hpp"
#include "wire/frame.hpp"

namespace vagus::sim {

constexpr size_t kChaosWaitingMax = 16384;  // frames in a line; what comes then is lost

class ChaosLine {
public:
    // Borrowed until end(); of Lost, Doubled, Delayed, Reordered, Unplugged, Hung, Slow. A node
    // that is unplugged or hangs loses also what is on its way.
    void begin(const ChaosFault& fault, uint64_t seed);
    void end(const ChaosFault& fault);
    // What acts on it is drawn from another seed from now on, in that stream (chaos_seed()).
    void reseed(uint64_t seed, uint64_t stream);
    // As without faults.
    void reset();

    // Nothing acts on it, and nothing waits in it.
    bool is_plain() const { return acting_.empty() && waiting_.empty(); }
    void put(const wire::Frame& frame, Time now);
    // The next frame that is due by `now`.
    bool take(wire::Frame& frame, Time now);

private:
    struct Acting {
        const ChaosFault* fault;
        uint64_t seed = 0;
    };
    struct Waiting {
        Time due{};
        wire::Frame frame;
    };
    // What becomes of one frame.
    struct Fate {
        int copies = 1;
        Duration late{};
        bool held_back = false;
    };
    Fate decide(Time now);

    std::vector<Acting> acting_;
    std::deque<Waiting> waiting_;  // by due, then in the order in which they came
    Time latest_{};                // due of those that keep their order
    Time put_at_{};                // the last put()
    uint64_t of_instant_ = 0;      // how many there were at that instant before it
};

}  // namespace vagus::sim
