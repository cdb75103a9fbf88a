#include "toolbox/needs_bus.hpp"

#include <fmt/format.h>

namespace vagus::toolbox {

namespace {

template <typename Element>
Status check(const plan::GraphPlan& plan, const Element& element) {
    if (!element.of || element.of->bus_events.empty()) return Status::done();
    return Error{Code::Unavailable,
                 fmt::format("the plan {} needs a bus: the template {} of \"{}\" works on a node",
                             plan.name, element.of->name, element.name)};
}

template <typename List>
Status check_all(const plan::GraphPlan& plan, const List& list) {
    for (const auto& element : list) TRY(check(plan, element));
    return Status::done();
}

}  // namespace

Status check_without_bus(const plan::Graph& graph) {
    for (const plan::GraphPlan& plan : graph.plans) {
        TRY(check_all(plan, plan.globals));
        for (const plan::GraphActor& actor : plan.actors) {
            TRY(check(plan, actor));
            TRY(check_all(plan, actor.supervisors));
        }
    }
    return Status::done();
}

}  // namespace vagus::toolbox
