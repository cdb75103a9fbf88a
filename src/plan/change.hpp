// Whether a new version of a plan can take over while the plan runs (docs/plans.md, P31): what
// is in its way, from what is going on now.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plan/graph.hpp"

namespace vagus::plan {

// The versions of a run are all kept to its end, since its trace names what is in them.
constexpr size_t kChangesMax = 1000;

// A new version of plan files: all plans again, checked together, and which files it is about.
struct NewVersion {
    std::shared_ptr<const Graph> graph;  // owners: its maker, the run, followers of its trace
    std::vector<std::string> files;      // as GraphPlan::file
};

// One plan that runs, as what is active in it was started.
struct Underway {
    std::string_view path;
    const GraphPlan* plan = nullptr;
    const GraphActor* actor = nullptr;                  // the active one
    std::vector<const GraphSupervisor*> watching = {};  // global ones
    // The actor that an event leads to while the active one is being stopped; empty: none.
    std::string_view on_its_way_to = {};
};

// A sentence for each; empty: it can take over.
std::vector<std::string> reasons_against(const Underway& underway, const GraphPlan& next);

}  // namespace vagus::plan
