#include "serve/run/break_place.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/nearest.hpp"
#include "plan/check.hpp"
#include "plan/formula.hpp"

namespace vagus::serve {

namespace {

using Names = std::vector<std::string>;

Status check_name(const std::string& whose, const std::string& what, const std::string& name,
                  const Names& known) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return Status::done();
    return Error{Code::NotFound, fmt::format("{} has no {} “{}”; {}", whose, what, name,
                                             known_instead(name, known))};
}

// Of an actor or a supervisor; nothing is known of a template that no toolbox has.
template <typename Element>
Status check_outcome(const PlanBreakpoint& wanted, const Element& element,
                     const std::vector<plan::Rule>& rules, const plan::Plan& plan,
                     const plan::Library& library) {
    if (wanted.kind == "actor" || wanted.outcome.empty()) return Status::done();
    const bool event = wanted.kind == "event";
    Names known;
    for (const plan::Rule& rule : rules) known.push_back(rule.name);
    if (element.template_name) {
        const plan::Template* const of =
            plan::find_template(plan, library, *element.template_name, event);
        if (!of) return Status::done();
        for (const plan::Outcome& one : of->outcomes) {
            if (std::find(known.begin(), known.end(), one.name) == known.end()) {
                known.push_back(one.name);
            }
        }
    }
    return check_name((event ? "the supervisor " : "the actor ") + element.name,
                      event ? "event" : "state", wanted.outcome, known);
}

Status check_actor(const PlanBreakpoint& wanted, const plan::Plan& plan,
                   const plan::Library& library) {
    Names known;
    for (const plan::Actor& actor : plan.actors) {
        known.push_back(actor.name);
        if (actor.name == wanted.element) {
            return check_outcome(wanted, actor, actor.states, plan, library);
        }
    }
    return check_name("the plan " + plan.name, "actor", wanted.element, known);
}

Status check_supervisor(const PlanBreakpoint& wanted, const plan::Plan& plan,
                        const plan::Library& library) {
    std::vector<const plan::Supervisor*> all;
    for (const plan::Supervisor& one : plan.globals) all.push_back(&one);
    for (const plan::Actor& actor : plan.actors) {
        for (const plan::Supervisor& one : actor.supervisors) all.push_back(&one);
    }
    Names known;
    for (const plan::Supervisor* one : all) {
        known.push_back(one->name);
        if (one->name == wanted.element) {
            return check_outcome(wanted, *one, one->events, plan, library);
        }
    }
    return check_name("the plan " + plan.name, "supervisor", wanted.element, known);
}

}  // namespace

Status check_break_place(const PlanBreakpoint& wanted, const plan::Plan& plan,
                         const plan::Library& library) {
    if (wanted.kind == "condition" || wanted.element.empty()) return Status::done();
    return wanted.kind == "event" ? check_supervisor(wanted, plan, library)
                                  : check_actor(wanted, plan, library);
}

Status check_break_variables(const PlanBreakpoint& wanted, const plan::Plan& plan) {
    const auto formula = plan::parse_formula(wanted.condition);
    if (wanted.condition.empty() || !formula.ok()) return Status::done();
    Names known;
    for (const plan::Variable& one : plan.configuration) known.push_back(one.name);
    for (const std::string& name : formula.value().names()) {
        TRY(check_name("the plan " + plan.name, "variable", name, known));
    }
    return Status::done();
}

Status check_break_condition(const PlanBreakpoint& wanted) {
    if (wanted.condition.empty()) return Status::done();
    const auto formula = plan::parse_formula(wanted.condition);
    if (formula.ok()) return Status::done();
    return Error{Code::BadInput, "in.condition: " + formula.error().what};
}

}  // namespace vagus::serve
