// The frame of its own bus for each event that a robot sent to its fleet, by the number of the
// event in the fleet. So the robot that hears the event knows where it came from. As many are kept
// as a member still accepts as new (fleet/limits.hpp).
//
//     SentToFleet sent;
//     sent.add(number, its_frame);               // of a member, numbers count up
//     const uint32_t frame = sent.frame_of(number);             // 0: not known any more
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>

#include "fleet/limits.hpp"

namespace vagus::session {

class SentToFleet {
public:
    void add(int64_t number, uint32_t frame) {
        sent_.push_back({number, frame});
        if (sent_.size() > fleet::kNumbersRemembered) sent_.pop_front();
    }
    uint32_t frame_of(int64_t number) const {
        const auto found = std::ranges::lower_bound(sent_, number, {}, &Sent::number);
        return found != sent_.end() && found->number == number ? found->frame : 0;
    }

private:
    struct Sent {
        int64_t number = 0;
        uint32_t frame = 0;
    };
    std::deque<Sent> sent_;
};

}  // namespace vagus::session
