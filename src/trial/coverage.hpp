// What a set of runs went through: actors, states, supervisors, events and pairs of consecutive
// actors of plans; lines and branches of scripts. What nothing went through is there too, with 0.
//
//     PlanCounter plans(graph);
//     run.listen([&](const plan::TraceEvent& event) { plans.see(event); });
//     …
//     all.add(plans.coverage());
//     print(format_table(all));
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "plan/graph.hpp"
#include "plan/trace.hpp"

namespace vagus::trial {

struct PlanCoverage {
    // How often, by name: "followWall", "followWall: WallLost", "touch",
    // "touch: TouchSensorPressed" and "searchFirstWall, findWallAngle". Supervisors of actors are
    // named with them: "followWall.wallTouch".
    using Counts = std::map<std::string, uint64_t>;
    Counts actors, states, supervisors, events, pairs;
};

struct ScriptCoverage {
    std::map<int, uint64_t> lines;  // how often the busiest instruction of a line was executed
    // By line, and number among its branches: how often the condition held, and did not.
    std::map<std::pair<int, int>, std::array<uint64_t, 2>> branches;
    // Of a real robot: only these lines are proved by frames; nothing is known about others.
    bool only_told = false;
};

// By file.
struct Coverage {
    std::map<std::string, PlanCoverage> plans;
    std::map<std::string, ScriptCoverage> scripts;

    // Sums.
    void add(const Coverage& other);
};

// The kinds of a PlanCoverage, with the words of the table.
struct CoverageKind {
    std::string_view name;
    PlanCoverage::Counts PlanCoverage::*counts;
};
const std::vector<CoverageKind>& coverage_kinds();

// Counts what a run's trace tells.
class PlanCounter {
public:
    // The graph is borrowed.
    explicit PlanCounter(const plan::Graph& graph);
    // Whether a run of that plan can say so next: of lines that were not made by one.
    bool fits(const plan::TraceEvent& event) const;
    void see(const plan::TraceEvent& event);
    Coverage coverage() const;

private:
    struct Level {
        size_t plan = 0;
        std::string actor = {};  // that started last
        int sub_plan = -1;       // that it calls
    };
    void start(size_t level, std::string_view actor);
    std::string name_of(size_t level, const plan::EventRaised& raised) const;
    PlanCoverage& counts_of(size_t level) { return counts_[levels_[level].plan]; }

    const plan::Graph& graph_;
    std::vector<PlanCoverage> counts_;  // by plan of the graph
    std::vector<Level> levels_;
};

// ---- what is shown of it ----

// For people: a line for each plan and each script, "19 of 22".
std::string format_table(const Coverage& coverage);
// Those that nothing went through, by kind, a line each.
std::string format_missing(const PlanCoverage& coverage);
// The lines of a script that frames told of, a line each.
std::string format_told(const ScriptCoverage& coverage);
constexpr std::string_view kLcovBegins = "TN:\nSF:";
// Scripts as the tracefile of lcov 1.16 (man geninfo, "FILES"); without those of which only some
// lines are known, for it would take the others for no lines at all.
std::string format_lcov(const Coverage& coverage);

// One line of JSON, for a pipe between our own processes, and back.
std::string format_coverage(const Coverage& coverage);
Coverage read_coverage(const JsonValue& json);

}  // namespace vagus::trial
