#include "toolbox/needs_bus.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vagus::toolbox {

namespace {

// Calls `look(plan, actor or supervisor)` for each that is made of a template.
template <typename Look>
void for_each_element(const plan::Graph& graph, const Look& look) {
    for (const plan::GraphPlan& plan : graph.plans) {
        for (const plan::GraphSupervisor& supervisor : plan.globals) look(plan, supervisor);
        for (const plan::GraphActor& actor : plan.actors) {
            if (actor.of) look(plan, actor);
            for (const plan::GraphSupervisor& supervisor : actor.supervisors) {
                look(plan, supervisor);
            }
        }
    }
}

bool share_one(const NodeNames& names, const std::vector<NodeNames>& nodes) {
    return std::any_of(nodes.begin(), nodes.end(), [&names](const NodeNames& others) {
        return std::find_first_of(names.begin(), names.end(), others.begin(), others.end()) !=
               names.end();
    });
}

}  // namespace

Status check_without_bus(const plan::Graph& graph) {
    Status found = Status::done();
    for_each_element(graph, [&found](const plan::GraphPlan& plan, const auto& element) {
        if (element.of->bus.events.empty() || !found.ok()) return;
        found = Error{Code::Unavailable,
                      fmt::format("the plan {} needs a bus: the template {} of \"{}\" works on a "
                                  "node",
                                  plan.name, element.of->name, element.name)};
    });
    return found;
}

Status check_without_fleet(const plan::Graph& graph) {
    Status found = Status::done();
    for_each_element(graph, [&found](const plan::GraphPlan& plan, const auto& element) {
        if (!element.of->needs_fleet || !found.ok()) return;
        found = Error{Code::Unavailable,
                      fmt::format("the plan {} needs a fleet: the template {} of \"{}\" asks the "
                                  "other robots; name one in the robot's vagus.json, as \"fleet\": "
                                  "{{ \"name\": \"lab\" }}, and run it in a world with `vagus "
                                  "sim`, or on a robot with `vagus serve --fleet`",
                                  plan.name, element.of->name, element.name)};
    });
    return found;
}

std::vector<NodeNames> nodes_needed(const plan::Graph& graph) {
    std::vector<NodeNames> needed;
    for_each_element(graph, [&needed](const plan::GraphPlan&, const auto& element) {
        for (const NodeNames& names : element.of->bus.nodes) {
            if (std::find(needed.begin(), needed.end(), names) == needed.end()) {
                needed.push_back(names);
            }
        }
    });
    return needed;
}

std::set<std::string> starts_on(const std::vector<NodeNames>& nodes, const plan::Library& library) {
    std::set<std::string> starts;
    for (const plan::Toolbox& toolbox : library.toolboxes()) {
        for (const plan::Template& one : toolbox.templates) {
            // Of a template that works on other nodes, too, nobody says which event is for which;
            // what it begins here, a template that works here alone begins as well.
            const bool works_there =
                !one.bus.nodes.empty() &&
                std::all_of(one.bus.nodes.begin(), one.bus.nodes.end(),
                            [&nodes](const NodeNames& names) { return share_one(names, nodes); });
            if (works_there) starts.insert(one.bus.starts.begin(), one.bus.starts.end());
        }
    }
    return starts;
}

}  // namespace vagus::toolbox
