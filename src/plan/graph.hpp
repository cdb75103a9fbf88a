// A checked plan, ready to run: names have become indices, formulas know their variables, every
// state and event its target. Made once, never changed, shared by all runs of the plan.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plan/check.hpp"
#include "plan/formula.hpp"
#include "plan/template.hpp"

namespace vagus::plan {

// Where a state or event leads: the index of an actor, or one of these.
constexpr int kTargetTerminate = -1;
constexpr int kTargetIgnore = -2;

struct GraphInput {
    std::string name;
    std::optional<Type> type;        // empty: any
    std::optional<Formula> formula;  // empty: `value` is it, converted already
    std::vector<int> slots;          // variables of the formula's names()
    Value value;                     // without formula
    bool fed = false;                // by the plan; else it is the default
};

struct GraphOutput {
    std::string name;
    int source = 0;  // index among the outputs that the template declares
    int slot = 0;    // variable written
};

struct GraphSupervisor {
    std::string name;
    const Template* of = nullptr;
    int64_t period_us = 0;  // 0: waits for events itself
    std::vector<GraphInput> inputs;
    std::vector<GraphOutput> outputs;  // in the order of `out`
    std::vector<int> targets;          // of each event of the template
};

struct GraphActor {
    std::string name;
    const Template* of = nullptr;  // nullptr: a sub-plan
    int sub_plan = -1;
    std::string sub_plan_file;       // of a sub-plan
    std::vector<GraphInput> inputs;  // in order of declaration
    std::vector<GraphOutput> outputs;
    std::vector<std::string> states;
    std::vector<int> targets;                 // of each state
    std::vector<std::pair<int, int>> shared;  // sub-plan's slot, this plan's slot
    std::vector<std::string> inner_outputs;   // of a sub-plan: its variables, by `source`
    std::vector<GraphSupervisor> supervisors;
};

struct GraphVariable {
    std::string name;
    Type type = Type::Int;
    Value initial;
    Access access = Access::Local;
};

struct GraphPlan {
    std::string name;
    std::string file;
    std::vector<GraphVariable> variables;
    int start = 0;
    std::vector<GraphSupervisor> globals;
    std::vector<GraphActor> actors;
};

struct Graph {
    std::vector<GraphPlan> plans;  // the outermost first
};

// Indices; -1 if there is none of that name.
int find_variable(const GraphPlan& plan, std::string_view name);
int find_actor(const GraphPlan& plan, std::string_view name);
// Among the supervisors of a start tag or of an actor.
int find_supervisor(const std::vector<GraphSupervisor>& among, std::string_view name);

// `checked` has no error; its library must outlive the graph.
Graph make_graph(const Checked& checked);

}  // namespace vagus::plan
