// A run of `vagus sim` as plain lines: time, poses and key sensors once a simulated second, events
// as they happen.
//
//     1.000 s  thymio  at 0.52, 0.31 m  45 deg  prox 0 0 1203 0 0 0 0  ground 920 870  left 200 …
//     1.230 s  event  thymio: found 1203
#pragma once

#include <vector>

#include "session/sim_session.hpp"

namespace vagus::cli {

constexpr Duration kStateEvery = std::chrono::seconds(1);  // simulated
constexpr uint64_t kEventLinesMax = 20;  // in one such second; the rest is told as a number

class SimLines {
public:
    explicit SimLines(const session::SimSession& session) : session_(session) {}

    // Events, loads and faults to stdout, mistakes and troubles to stderr. False once nobody reads
    // stdout.
    bool tell(const std::vector<session::Note>& notes);
    // The state of the robots if a second has passed since the last time.
    bool tell_state();

private:
    const session::SimSession& session_;  // owned by the run around
    Time next_{};
    uint64_t event_lines_ = 0;
};

}  // namespace vagus::cli
