// How fast a live view lets simulated time pass, as a person wants it: the keys + - and space.
#pragma once

#include <string>

#include "base/time.hpp"
#include "cli/screen/keys.hpp"

namespace vagus::cli {

// A machine that cannot keep up slows time down instead of running after it.
constexpr Duration kBehindMax = std::chrono::milliseconds(200);

class Pace {
public:
    // 0: as fast as it goes.
    explicit Pace(double speed = 1) : speed_(speed) {}

    bool paused() const { return paused_; }
    bool hurries() const { return speed_ == 0; }
    // "x1", "x0.5", "max"
    std::string text() const;
    // True if the key was one of these: faster and slower go to the next step of a ladder.
    bool act(Key key);

    // Simulated time that is due after so much real time, with what is still owed.
    Duration due(Duration real);
    // So much of it has passed.
    void pay(Duration simulated) { owed_ -= simulated; }
    Duration owes() const { return owed_; }
    void forget() { owed_ = {}; }

    // When a step of simulated time that began at `before` ends, at `now` at the earliest for one
    // that hurries or is late.
    Time end_of(Time before, Duration simulated, Time now) const;

private:
    double speed_;
    bool paused_ = false;
    Duration owed_{};
};

}  // namespace vagus::cli
