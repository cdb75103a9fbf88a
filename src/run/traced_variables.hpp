// What the variables of a run hold, at each line of its trace: rebuilt from the trace alone, so
// that also a value which stood only between two writes of one decision is seen.
#pragma once

#include <memory>
#include <vector>

#include "plan/graph.hpp"
#include "plan/trace.hpp"

namespace vagus::run {

// The number of plans around the one that a line of the trace tells of; 0: the outermost.
int level_of(const plan::TraceEvent& event);

// Where a variable's value is kept: that of a shared one by an outer plan.
struct VariablePlace {
    int level = 0;
    int slot = 0;
};

class TracedVariables {
public:
    // Borrowed; after a change (P31) what its line of the trace brings counts.
    explicit TracedVariables(const plan::Graph& graph) : graph_(&graph) {}

    void see(const plan::TraceEvent& event);

    int depth() const { return static_cast<int>(levels_.size()); }
    const plan::GraphPlan& plan_at(int level) const { return *at(level).plan; }
    const plan::Value& value(int level, int slot) const;
    // Of the write that was seen last.
    VariablePlace last_write() const { return last_write_; }

private:
    struct Level {
        const plan::GraphPlan* plan = nullptr;
        std::vector<plan::Value> values;          // of shared variables: the caller's count
        const plan::GraphActor* actor = nullptr;  // the one that started last
    };
    const Level& at(int level) const { return levels_[static_cast<size_t>(level)]; }
    VariablePlace place_of(VariablePlace place) const;
    void start_plan(int level);
    void change(std::shared_ptr<const plan::Graph> graph);

    const plan::Graph* graph_;                    // the newest (P31)
    std::shared_ptr<const plan::Graph> changed_;  // that, after a change; owners: see PlanChanged
    std::vector<Level> levels_;
    VariablePlace last_write_;
};

}  // namespace vagus::run
