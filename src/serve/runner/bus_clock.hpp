// The clock of a plan on a bus, as pages see it: that of the wall since the run began, but it
// is paused while the plan is held.
#pragma once

#include "base/time.hpp"

namespace vagus::serve {

class BusClock {
public:
    void start(Time wall) {
        passed_ = Duration{};
        counted_at_ = wall;
    }
    // Until now it was held, or not.
    void count(Time wall, bool held) {
        if (!held) passed_ += wall - counted_at_;
        counted_at_ = wall;
    }
    double now() const { return seconds_of(passed_); }

private:
    Duration passed_{};
    Time counted_at_{};
};

}  // namespace vagus::serve
