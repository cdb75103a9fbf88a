// When faults begin and end, one after the other.
//
//     ChaosClock clock(faults);
//     while (const auto edge = clock.next(now)) {
//         if (edge->begins) begin(*edge->fault);
//     }
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "sim/chaos.hpp"

namespace vagus::sim {

struct ChaosEdge {
    Time at{};
    const ChaosFault* fault = nullptr;
    bool begins = true;
};

class ChaosClock {
public:
    // The faults are borrowed. One that ends when it begins, has one edge.
    explicit ChaosClock(std::span<const ChaosFault> faults) {
        for (const ChaosFault& fault : faults) {
            edges_.push_back({fault.from, &fault, true});
            const std::optional<Time> end = end_of(fault);
            if (end && *end > fault.from) edges_.push_back({*end, &fault, false});
        }
        std::ranges::stable_sort(edges_, {}, &ChaosEdge::at);
    }

    // The next one that is due by `now`, by time, then in the order of the faults.
    std::optional<ChaosEdge> next(Time now) {
        if (next_ == edges_.size() || edges_[next_].at > now) return std::nullopt;
        return edges_[next_++];
    }
    void restart() { next_ = 0; }

private:
    std::vector<ChaosEdge> edges_;
    size_t next_ = 0;
};

}  // namespace vagus::sim
