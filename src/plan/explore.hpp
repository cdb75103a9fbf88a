// What can follow from a plan's drawing alone, without running it (docs/explore.md): each actor may
// end in each of its states at any time, each supervisor that watches may raise each of its events,
// in any order and together. What the rules of docs/plans.md, section 4, make of that is walked
// through situation by situation; data is left open, so a plan may take every branch.
//
//     const Exploration found = explore(checked.plans, make_graph(checked), {.depth = 3});
//     for (const ExploreFinding& finding : found.findings) print(format_text(finding));
//
// A situation is: which actor is active in each plan of those that run inside one another, and
// which global supervisors rest (P23). Each is walked from once, the nearest to the start first, so
// the path of a finding is a shortest one.
//
// What is taken for granted:
// - Inside a sub-plan all code may fail, so its state Error may come at any time. An error does not
//   count as a way to the end, but where a template does nothing else (Template::only_fails).
// - Two supervisors that look at the same thing at the same instant raise together, and the order
//   of P21 says which of them wins: those of one actor with the same template, inputs and period;
//   and those of period 0 with the same constant inputs, in plans that run inside one another, but
//   two global ones of one plan. The later one can then never be taken while the earlier watches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "plan/graph.hpp"
#include "plan/machine.hpp"
#include "plan/model.hpp"

namespace vagus::plan {

constexpr int kExploreDepth = 8;  // plans inside one another, the outermost is 1
constexpr int kExploreDepthMax = kPlanDepthMax;
constexpr size_t kSituationsMax = 1'000'000;
constexpr size_t kExploreStepsMax = 10'000'000;  // between situations

enum class ExploreKind : uint8_t {
    Unreached,     // an actor that can never be reached
    NoEnd,         // a place from which the end cannot be reached any more
    NoTime,        // a loop in which no time passes
    NeverWins,     // a supervisor none of whose events can ever be taken
    Unwritten,     // a variable that is read before anything wrote it
    EndlessCalls,  // sub-plans that can call each other without end
};
// "unreached", "no-end", "no-time", "never-wins", "unwritten", "endless-calls".
std::string_view name_of(ExploreKind kind);

struct ExploreStep {
    enum class Kind : uint8_t {
        End,     // an actor ends in the state `outcome`
        Return,  // the state `outcome` of an actor whose sub-plan has ended so
        Event,   // a supervisor raises the event `outcome`
        Call,    // an actor begins its sub-plan
        Error,   // the code of an actor or supervisor fails, which ends its plan
        Skip,    // a sub-plan beyond the depth, taken as one step with the result `outcome`
    };
    Kind kind = Kind::End;
    std::string plan;     // instance path: "WallFollow/calibrate"
    std::string element;  // actor or supervisor
    std::string outcome;  // state, event or result
    std::string target;   // the actor that follows, or @terminate; empty: none
};
std::string_view name_of(ExploreStep::Kind kind);

struct ExploreFinding {
    ExploreKind kind = ExploreKind::Unreached;
    std::string file;
    std::string plan;     // its name
    std::string element;  // actor, supervisor or variable
    Place at;
    std::string message;            // one sentence
    std::vector<ExploreStep> path;  // from the start of the run; empty: it is so from the start
};

struct ExploreOptions {
    int depth = kExploreDepth;  // 1 to kExploreDepthMax
    size_t situations = kSituationsMax;
    size_t steps = kExploreStepsMax;
};

struct Exploration {
    std::vector<ExploreFinding> findings;  // by kind, then as they are in the files
    size_t situations = 0;                 // seen; the ends of the run are not counted
    size_t trapped = 0;                    // of them: from which the end cannot be reached any more
    bool complete = false;  // no limit was reached. If one was, only what was found on the way is
                            // told: loops, variables, calls
    bool skipped = false;   // some sub-plans were beyond the depth, and taken as one step
    int depth = 0;
};

// Plans without an error, the outermost first, and the graph made of them.
Exploration explore(const std::vector<Plan>& plans, const Graph& graph,
                    const ExploreOptions& options = {});

// "FILE:LINE:COL: ELEMENT: sentence [kind]", then the path, one step a line.
std::string format_text(const ExploreFinding& finding);
// In words: "drive ends in Done: on to turn".
std::string format_text(const ExploreStep& step);
// What was seen, in one line; honest about limits.
std::string format_summary(const Exploration& exploration);
// One object: docs/explore.md.
std::string format_json(const Exploration& exploration);

}  // namespace vagus::plan
