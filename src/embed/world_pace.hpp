// The clock of a world that follows the wall clock from the first call on. Those who have joined
// its bus are served meanwhile.
//
//     WorldPace pace(links);
//     pace.wait(at);                 // until that instant is due
#pragma once

#include <chrono>
#include <optional>

#include "base/time.hpp"
#include "net/links.hpp"

namespace vagus::embed {

// A machine that cannot keep up slows time down instead.
constexpr Duration kBehindMax = std::chrono::milliseconds(200);

class WorldPace {
public:
    explicit WorldPace(net::Links& net) : net_(net) {}

    void wait(Time at) {
        const Time now = net_.now();
        // The first instant, and one that came much too late: a pause, or too slow a machine.
        if (!origin_ || now > *origin_ + at + kBehindMax) origin_ = now - at;
        const Time due = *origin_ + at;
        while (net_.now() < due) (void)net_.poll(due);
    }

private:
    net::Links& net_;
    std::optional<Duration> origin_;
};

}  // namespace vagus::embed
