// A run of `vagus sim` as plain lines: time, poses and key sensors once a simulated second, events
// as they happen.
//
//     1.000 s  thymio  at 0.52, 0.31 m  45 deg  prox 0 0 1203 0 0 0 0  ground 920 870  left 200 …
//     1.230 s  event  thymio: found 1203
//
// Of more than kRobotLinesMax robots a second is one line:
//     1.000 s  500 robots  498 moving  2 at rest  500 running a script  3 stopped by a fault
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "session/world_buses.hpp"

namespace vagus::cli {

constexpr Duration kStateEvery = std::chrono::seconds(1);  // simulated
constexpr size_t kRobotLinesMax = 20;                      // more robots are told as a summary
constexpr uint64_t kNoteLinesMax = 20;  // of a kind in one such second; the rest is counted

enum class LinesOn : uint8_t { Stdout, Stderr };

class SimLines {
public:
    SimLines(const session::WorldBuses& buses, LinesOn on);

    // A line of another kind among them. False once nobody reads stdout.
    bool put(const std::string& line) const;
    // Events, loads and faults; mistakes and troubles are on stderr in any case. False once nobody
    // reads stdout.
    bool tell(const std::vector<session::Note>& notes);
    // The state of the robots if a second has passed since the last time.
    bool tell_state();

private:
    // What there may be many of in a second.
    struct Tally {
        const char* word;
        uint64_t count = 0;
    };

    bool tell_one(Tally& tally, const session::Note& note);
    bool tell_more(Tally& tally) const;
    bool has_many_robots() const { return poses_.size() > kRobotLinesMax; }
    std::string summary();

    const session::WorldBuses& buses_;  // owned by the run around
    LinesOn on_;
    Time next_{};
    Tally events_{"event"};
    Tally loads_{"loaded"};
    Tally faults_{"fault"};
    Tally plans_{"plan"};
    Tally fleet_{"fleet"};
    Tally chaos_{"chaos"};
    std::vector<sim::Pose> poses_;  // at the last summary, by robot
};

}  // namespace vagus::cli
