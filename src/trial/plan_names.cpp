#include "trial/plan_names.hpp"

#include <algorithm>

namespace vagus::trial {

namespace {

void add_name(std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

void add_events(std::vector<std::string>& names,
                const std::vector<plan::GraphSupervisor>& supervisors) {
    for (const plan::GraphSupervisor& one : supervisors) {
        for (const plan::Outcome& event : one.of->outcomes) add_name(names, event.name);
    }
}

}  // namespace

std::vector<std::string> actors_of(const plan::Graph& graph) {
    std::vector<std::string> names;
    for (const plan::GraphPlan& plan : graph.plans) {
        for (const plan::GraphActor& actor : plan.actors) add_name(names, actor.name);
    }
    return names;
}

std::vector<std::string> events_of(const plan::Graph& graph) {
    std::vector<std::string> names;
    for (const plan::GraphPlan& plan : graph.plans) {
        add_events(names, plan.globals);
        for (const plan::GraphActor& actor : plan.actors) add_events(names, actor.supervisors);
    }
    return names;
}

std::vector<std::string> states_of(const plan::Graph& graph) {
    std::vector<std::string> names;
    for (const plan::GraphPlan& plan : graph.plans) {
        for (const plan::GraphActor& actor : plan.actors) {
            for (const std::string& state : actor.states) add_name(names, state);
        }
    }
    return names;
}

}  // namespace vagus::trial
