// The breakpoints of a plan's debugger: what they are, whether they fit the plan, when they are
// hit.
//
//     breakpoints.add({.kind = Breakpoint::Kind::Actor, .element = "turn"});       // its number
//     breakpoints.add({.kind = Breakpoint::Kind::Condition, .condition = "distance < 5"});
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plan/graph.hpp"
#include "plan/trace.hpp"
#include "run/expression.hpp"
#include "run/traced_variables.hpp"

namespace vagus::run {

constexpr size_t kBreakpointsMax = 1000;

struct Breakpoint {
    enum class Kind : uint8_t {
        Actor,     // `element` is about to begin: its inputs have not been read
        State,     // `element` has ended in the state `outcome` (empty: in any)
        Event,     // the supervisor `element` has raised the event `outcome` (empty: any)
        Condition  // `condition` has become true by a write; true from the start does not count
    };
    Kind kind = Kind::Actor;
    // The plan it is in, in each instance of it: its name or file; empty: the outermost.
    std::string plan = {};
    std::string element = {};
    std::string outcome = {};
    std::string condition = {};  // an Expression; for the other kinds one that must hold, too
    uint64_t stop_at = 1;        // stops at this hit and at each after it
    bool enabled = true;         // a disabled one counts no hits

    // Filled in by the debugger.
    int id = 0;
    uint64_t hits = 0;         // in this run
    std::string trouble = {};  // why the condition could not be evaluated; it then does not hold
};

class Breakpoints {
public:
    explicit Breakpoints(const plan::Graph& graph)
        : first_(graph), graph_(&graph), variables_(graph) {}

    // The number that it got. NotFound for names that the plan lacks, with the nearest one.
    Result<int> add(Breakpoint breakpoint);
    Status remove(int id);
    Status enable(int id, bool enabled);
    std::vector<Breakpoint> list() const;

    // A new run: no hits, no variables.
    void start_again();
    // Each line of the trace, then settle() at the end of each decision: an end or an event counts
    // with what it wrote. These give the breakpoints that stop the run, by number.
    std::vector<int> see(const plan::TraceEvent& event);
    std::vector<int> settle();
    std::vector<int> before_begin(int level, const plan::GraphActor& actor);

private:
    struct Kept {
        Breakpoint shown;
        std::string file;                       // of its plan
        const plan::GraphPlan* plan = nullptr;  // nullptr: gone in the newest version
        std::optional<Expression> condition;
        std::vector<bool> held;  // by level: whether the condition held there
    };

    Result<const plan::GraphPlan*> find_plan(const std::string& name) const;
    Status fit(Kept& kept) const;
    Status check_names(const Breakpoint& breakpoint, const plan::GraphPlan& plan) const;
    Result<Kept*> find(int id);
    struct Met {  // a state or event, to be decided when its writes are there
        Breakpoint::Kind kind;
        std::string_view element;
        std::string_view outcome;
        int level;
    };
    void meet(const Met& met, std::vector<int>& stopping);
    bool holds(Kept& kept, int level);
    void note_conditions(Kept& kept);
    void see_write(std::vector<int>& stopping);
    void hit(Kept& kept, std::vector<int>& stopping);

    void change(const plan::Graph& graph);

    const plan::Graph& first_;  // with which each run begins
    const plan::Graph* graph_;  // its newest version (P31), kept by variables_
    TracedVariables variables_;
    std::vector<Kept> kept_;
    std::optional<Met> met_;
    int last_id_ = 0;
};

}  // namespace vagus::run
