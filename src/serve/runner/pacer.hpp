// How a simulated clock follows the wall clock: at a speed, as fast as it goes, or not at all.
// Pure: told the time.
#pragma once

#include <algorithm>
#include <chrono>

#include "base/time.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kBehindMax = 200ms;  // a machine that cannot keep up slows time down instead
constexpr Duration kSlowest = 1h;       // between two instants
constexpr Duration kFastSlice = 20ms;   // of wall clock between two looks around at full speed

class Pacer {
public:
    void set(bool paused, double speed, Time wall) {
        paused_ = paused;
        speed_ = speed;
        wall_ = wall;
        real_since_ = wall;
        real_passed_ = Duration{};
    }
    // No time passes now; within a step it does.
    bool paused() const { return paused_ && steps_ <= Duration{}; }
    // What a person is told: a run that is stepped stays a paused one.
    bool held() const { return paused_; }
    double speed() const { return speed_; }
    // While paused, let so much pass.
    void step(Duration span) { steps_ += span; }

    // Called before `span` of simulated time passes: when it is due, by the wall clock.
    Time due(Duration span, Time wall) {
        if (steps_ > Duration{} || speed_ <= 0) return wall;
        wall_ = std::max(wall_, wall - kBehindMax);
        const double ticks = static_cast<double>(span.count()) / speed_;
        return wall_ + Duration(static_cast<Duration::rep>(
                           std::min(ticks, static_cast<double>(kSlowest.count()))));
    }
    void passed(Duration span, Time due_at) {
        if (steps_ > Duration{}) steps_ -= std::min(steps_, span);
        wall_ = due_at;
        real_passed_ += span;
    }
    // Measured since the last call of set(): simulated seconds a second.
    double real(Time wall) const {
        const Duration since = wall - real_since_;
        return since > Duration{}
                   ? static_cast<double>(real_passed_.count()) / static_cast<double>(since.count())
                   : 0;
    }

private:
    bool paused_ = true;
    double speed_ = 1;
    Duration steps_{};
    Time wall_{};  // when the last span was due
    Time real_since_{};
    Duration real_passed_{};
};

}  // namespace vagus::serve
