// Two recordings side by side: where each lane of them differs first (insight, section 7).
//
//     const Comparison found = TRY(compare_runs(a, b, {}));
//     for (const ComparedLane& lane : found.lanes) if (lane.difference) show(lane);
//
// Lanes are the channels of recordings: what came from outside, the trace of the plan, the events
// of the bus, the variables of each node, the pose of each robot and loose object, what is in the
// world, and how the run ended; the checks, too, where both are aligned at the start. Each robot
// with a project of its own has lanes of its own. What lies beyond the end of the shorter one is
// not compared, nor is the last second of one without an end, which may not have been written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "mcap/reader.hpp"
#include "record/compare_lanes.hpp"

namespace vagus::record {

// The instants that are laid one over the other.
struct Align {
    enum class At : uint8_t { Start, Actor, Event };
    At at = At::Start;
    // Of an actor, which begins; of an event of the bus or of a supervisor. Of robots with projects
    // of their own that of any, or of one as ROBOT/NAME.
    std::string name = {};
};

// "start", "actor NAME", "event NAME".
Result<Align> read_align(const std::vector<std::string>& words);

// What the two were started with, where that is not the same: a member of /vagus/run, or a file.
struct StartedApart {
    std::string what;  // "set", "file follow-wall/WallFollow.plan.json"
    std::string a;     // as JSON; of a file its bytes: "1204 bytes"; empty: there is none
    std::string b;
};

struct ComparedLane {
    std::string name;        // its channel; "/world/poses carbot", "end"
    std::string robot = {};  // whose project it belongs to; empty: nobody's
    uint64_t compared = 0;
    std::optional<LaneDifference> difference = {};
};

struct Comparison {
    Time start_a{};  // where they are aligned
    Time start_b{};
    std::vector<StartedApart> started;
    // Those that differ first, the earliest before the others; of one instant in the order above.
    std::vector<ComparedLane> lanes;

    bool differs() const { return !lanes.empty() && lanes.front().difference.has_value(); }
};

// The Error says which of them has no such actor or event, and what it has; or which is damaged,
// and where (damage.hpp).
Result<Comparison> compare_runs(const mcap::Reader& a, const mcap::Reader& b, const Align& align);

// A sentence or three lines for each difference, and JSON. Names are those of the files.
std::string format_comparison(const Comparison& found, const std::string& a, const std::string& b);
std::string format_comparison_json(const Comparison& found);

}  // namespace vagus::record
