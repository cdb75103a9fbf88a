// A run of a plan as people follow it: what happened, as sentences; who is active, who watches,
// what the variables hold. Made of the lines of the trace alone.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/screen/view.hpp"
#include "plan/graph.hpp"
#include "plan/model.hpp"
#include "plan/trace.hpp"
#include "run/traced_variables.hpp"

namespace vagus::cli {

constexpr size_t kHappeningsKept = 1000;
constexpr size_t kStoryValueMax = 200;  // bytes of a value in a sentence; the rest is left out

// "touch: TouchSensorPressed → backupCollision"; nothing for what the list of actors shows anyway.
std::optional<std::string> sentence_of(const plan::TraceEvent& event);

class PlanStory {
public:
    // Both are borrowed; the graph was made of the plan and those inside it.
    PlanStory(const plan::Graph& graph, const plan::Plan& outermost)
        : graph_(&graph), plan_(&outermost), variables_(graph) {}

    void see(const plan::TraceEvent& event);
    // All but the load of the bus.
    PlanPanelView panel(Time now) const;

private:
    // Of a global supervisor (P23): whether its remedy, an actor that is no computation, is active
    // or yet to come.
    enum class Rest : uint8_t { BeforeRemedy, Remedy };
    struct Level {  // a plan that runs
        std::string path;
        std::string actor;  // active; empty between two
        Time since{};
        std::map<std::string, Rest> resting;  // global supervisors that do not watch
        std::map<int, Time> changed;          // variables by slot
    };

    const plan::GraphActor* active(size_t level) const;
    void start_actor(size_t depth, std::string_view actor, Time at);
    void note(const plan::TraceEvent& event);
    void add_actors(PlanPanelView& panel, Time now) const;
    void add_watching(PlanPanelView& panel) const;
    void add_variables(PlanPanelView& panel, Time now) const;

    const plan::Graph* graph_;  // the newest version (P31), kept by variables_
    const plan::Plan* plan_;
    run::TracedVariables variables_;
    std::vector<Level> levels_;  // the outermost first
    std::deque<HappeningView> happenings_;
    size_t forgotten_ = 0;  // earlier ones
    std::string ended_;     // the result, once it is over
    bool failed_ = false;
};

}  // namespace vagus::cli
