#include "run/traced_variables.hpp"

#include <algorithm>
#include <utility>

namespace vagus::run {

int level_of(const plan::TraceEvent& event) {
    return static_cast<int>(std::count(event.plan.begin(), event.plan.end(), '/'));
}

void TracedVariables::see(const plan::TraceEvent& event) {
    const int level = level_of(event);
    if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        start_plan(level);
    } else if (const auto* changed = std::get_if<plan::PlanChanged>(&event.what)) {
        change(changed->graph);
    } else if (std::holds_alternative<plan::PlanEnded>(event.what)) {
        levels_.resize(static_cast<size_t>(level));
    } else if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        Level& here = levels_[static_cast<size_t>(level)];
        for (const plan::GraphActor& actor : here.plan->actors) {
            if (actor.name == started->actor) here.actor = &actor;
        }
    } else if (const auto* written = std::get_if<plan::VariableWritten>(&event.what)) {
        const auto& variables = at(level).plan->variables;
        for (size_t slot = 0; slot < variables.size(); ++slot) {
            if (variables[slot].name != written->variable) continue;
            last_write_ = place_of({level, static_cast<int>(slot)});
            Level& keeper = levels_[static_cast<size_t>(last_write_.level)];
            keeper.values[static_cast<size_t>(last_write_.slot)] = written->value;
        }
    }
}

void TracedVariables::start_plan(int level) {
    levels_.resize(static_cast<size_t>(level));
    const plan::GraphPlan* plan = &graph_->plans.front();
    if (level > 0) plan = &graph_->plans[static_cast<size_t>(at(level - 1).actor->sub_plan)];
    Level started{.plan = plan, .values = {}};
    for (const plan::GraphVariable& variable : plan->variables) {
        started.values.push_back(variable.initial);
    }
    levels_.push_back(std::move(started));
}

// All plans that run are of the new graph from now on: those that it does not change are the same
// in it. A plan whose actor has not begun yet knows none.
void TracedVariables::change(std::shared_ptr<const plan::Graph> graph) {
    if (graph.get() == graph_) return;  // told once for each plan that runs
    for (Level& level : levels_) {
        const Level before = std::exchange(level, {});
        for (const plan::GraphPlan& plan : graph->plans) {
            if (plan.file == before.plan->file) level.plan = &plan;
        }
        for (const plan::GraphVariable& variable : level.plan->variables) {
            const int slot = plan::find_variable(*before.plan, variable.name);
            level.values.push_back(slot < 0 ? variable.initial
                                            : before.values[static_cast<size_t>(slot)]);
        }
        const int actor = before.actor ? plan::find_actor(*level.plan, before.actor->name) : -1;
        if (actor >= 0) level.actor = &level.plan->actors[static_cast<size_t>(actor)];
    }
    graph_ = graph.get();
    changed_ = std::move(graph);
}

VariablePlace TracedVariables::place_of(VariablePlace place) const {
    while (place.level > 0) {
        const auto& shared = at(place.level - 1).actor->shared;
        const auto found =
            std::find_if(shared.begin(), shared.end(),
                         [slot = place.slot](const auto& pair) { return pair.first == slot; });
        if (found == shared.end()) break;
        place = {place.level - 1, found->second};
    }
    return place;
}

const plan::Value& TracedVariables::value(int level, int slot) const {
    const VariablePlace place = place_of({level, slot});
    return at(place.level).values[static_cast<size_t>(place.slot)];
}

}  // namespace vagus::run
