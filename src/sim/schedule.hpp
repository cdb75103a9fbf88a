// Whose turn is it? Everybody says when it is due next, and costs nothing until then.
//
//     Schedule schedule;
//     schedule.start(robots.size());                 // all are due at once
//     for (uint32_t each : schedule.due(now)) schedule.set(each, run(each, now));
//     schedule.call(3);                              // something was done to it: due at once
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/time.hpp"

namespace vagus::sim {

class Schedule {
public:
    void start(size_t count) {
        next_.assign(count, Time{});
        soonest_ = Time{};
    }
    void set(size_t who, Time next) {
        next_[who] = next;
        soonest_ = std::min(soonest_, next);
    }
    void call(size_t who) { set(who, Time{}); }

    // Those due at `now` or before, ascending; borrowed until the next call. Each is to be set()
    // again, or it is never due again.
    const std::vector<uint32_t>& due(Time now) {
        due_.clear();
        if (soonest_ > now) return due_;
        soonest_ = Time::max();
        for (size_t who = 0; who < next_.size(); ++who) {
            if (next_[who] > now) {
                soonest_ = std::min(soonest_, next_[who]);
            } else {
                next_[who] = Time::max();
                due_.push_back(static_cast<uint32_t>(who));
            }
        }
        return due_;
    }

private:
    std::vector<Time> next_;
    std::vector<uint32_t> due_;
    Time soonest_{};  // nobody is due before
};

}  // namespace vagus::sim
