#include "serve/follow/plan_outline.hpp"

#include "plan/check.hpp"

namespace vagus::serve {

namespace {

std::vector<PlanOutline::Supervisor> outlines_of(const std::vector<plan::Supervisor>& supervisors) {
    std::vector<PlanOutline::Supervisor> made;
    for (const plan::Supervisor& one : supervisors) {
        PlanOutline::Supervisor& outline = made.emplace_back();
        outline.name = one.name;
        for (const plan::Rule& rule : one.events) outline.events.push_back(rule.name);
    }
    return made;
}

PlanOutline::Actor outline_of(const plan::Plan& plan, const plan::Actor& actor) {
    PlanOutline::Actor outline;
    outline.name = actor.name;
    outline.template_name = actor.template_name.value_or(actor.plan.value_or(""));
    if (actor.plan) outline.file = plan::path_of_sub_plan(plan.file, *actor.plan);
    outline.supervisors = outlines_of(actor.supervisors);
    return outline;
}

PlanOutline outline_of(const plan::Plan& plan) {
    PlanOutline outline;
    outline.file = plan.file;
    outline.name = plan.name;
    for (const plan::Variable& one : plan.configuration) {
        const std::string_view type = one.type ? plan::name_of(*one.type) : "float";
        outline.configuration.push_back({one.name, std::string(type), one.unit});
    }
    outline.globals = outlines_of(plan.globals);
    for (const plan::Actor& one : plan.actors) outline.actors.push_back(outline_of(plan, one));
    return outline;
}

}  // namespace

PlanOutlines outlines_of(const std::vector<plan::Plan>& plans) {
    PlanOutlines outlines;
    for (const plan::Plan& one : plans) outlines.push_back(outline_of(one));
    return outlines;
}

}  // namespace vagus::serve
