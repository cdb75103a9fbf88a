#include "run/debug_view.hpp"

#include <fmt/format.h>

#include "base/nearest.hpp"
#include "run/expression.hpp"

namespace vagus::run {

namespace {

std::string hint_for(const std::string& name, const std::vector<std::string>& known) {
    const std::string near = nearest(name, known);
    if (!near.empty()) return fmt::format("did you mean {}?", near);
    return known.empty() ? "there is none" : fmt::format("there are: {}", fmt::join(known, ", "));
}

// Calls see(supervisor, place) for each supervisor of a level, in the order of P21.
template <typename See>
void each_supervisor(const plan::Machine& machine, int level, See see) {
    const auto& globals = machine.plan_at(level).globals;
    for (size_t i = 0; i < globals.size(); ++i) {
        see(globals[i], plan::WatchPlace{level, true, static_cast<int>(i)});
    }
    const plan::GraphActor* actor = machine.actor_at(level);
    if (!actor) return;
    for (size_t i = 0; i < actor->supervisors.size(); ++i) {
        see(actor->supervisors[i], plan::WatchPlace{level, false, static_cast<int>(i)});
    }
}

std::vector<std::string> names_of(const std::vector<plan::Outcome>& outcomes) {
    std::vector<std::string> names;
    for (const plan::Outcome& outcome : outcomes) names.push_back(outcome.name);
    return names;
}

LevelNow look_at(const plan::Machine& machine, int level) {
    const plan::GraphActor* actor = machine.actor_at(level);
    LevelNow seen{.path = machine.path_at(level),
                  .actor = actor ? actor->name : "",
                  .activation = machine.activation_at(level),
                  .phase = machine.phase_at(level),
                  .variables = {},
                  .supervisors = {}};
    const auto& variables = machine.plan_at(level).variables;
    for (size_t i = 0; i < variables.size(); ++i) {
        seen.variables.push_back(
            {variables[i].name, variables[i].type, machine.variable(level, static_cast<int>(i))});
    }
    each_supervisor(
        machine, level,
        [&](const plan::GraphSupervisor& supervisor, const plan::WatchPlace& place) {
            seen.supervisors.push_back({supervisor.name, place.global, machine.watch_at(place) != 0,
                                        names_of(supervisor.of->outcomes)});
        });
    return seen;
}

Status check_level(const plan::Machine& machine, int level) {
    if (level >= 0 && level < machine.depth()) return Status::done();
    if (machine.depth() == 0) {
        return Error{
            Code::Refused,
            "the run has not started: there are no variables yet; step to its first actor"};
    }
    return Error{Code::NotFound,
                 fmt::format("there is no level {}; the plans that run have the levels 0 to {}",
                             level, machine.depth() - 1)};
}

// The supervisor's event and outputs, converted as its declaration says.
Result<plan::Given> make_given(const plan::Template& of, const std::string& event,
                               const std::vector<std::pair<std::string, plan::Value>>& outputs) {
    plan::Given given{.outcome = plan::find_outcome(of, event), .outputs = {}};
    if (given.outcome < 0) {
        return Error{Code::NotFound, fmt::format("{} has no event \"{}\"; {}", of.name, event,
                                                 hint_for(event, names_of(of.outcomes)))};
    }
    given.outputs.resize(of.outputs.size());
    std::vector<std::string> known;
    for (const plan::OutputDeclaration& output : of.outputs) known.push_back(output.name);
    for (const auto& [name, value] : outputs) {
        const int index = plan::find_output(of, name);
        if (index < 0) {
            return Error{Code::NotFound, fmt::format("{} has no output \"{}\"; {}", of.name, name,
                                                     hint_for(name, known))};
        }
        const auto at = static_cast<size_t>(index);
        const auto type = of.outputs[at].type;
        const Result<plan::Value> converted = type ? convert(value, *type) : Result(value);
        if (!converted.ok()) {
            return Error{Code::BadInput,
                         fmt::format("the output {}: {}", name, converted.error().what)};
        }
        given.outputs[at] = converted.value();
    }
    return given;
}

}  // namespace

Where look(const plan::Machine& machine) {
    Where seen;
    for (int level = 0; level < machine.depth(); ++level) {
        seen.levels.push_back(look_at(machine, level));
    }
    return seen;
}

Result<plan::Value> evaluate(const plan::Machine& machine, int level, std::string_view expression) {
    TRY(check_level(machine, level));
    const Expression parsed = TRY(Expression::parse(expression, machine.plan_at(level)));
    std::vector<plan::Value> values;
    for (const int slot : parsed.slots()) values.push_back(machine.variable(level, slot));
    return parsed.evaluate(values);
}

Result<int> find_variable(const plan::Machine& machine, int level, const std::string& name) {
    TRY(check_level(machine, level));
    const plan::GraphPlan& plan = machine.plan_at(level);
    std::vector<std::string> known;
    for (const plan::GraphVariable& variable : plan.variables) {
        if (variable.name == name) return static_cast<int>(known.size());
        known.push_back(variable.name);
    }
    return Error{Code::NotFound, fmt::format("the plan {} has no variable \"{}\"; {}", plan.name,
                                             name, hint_for(name, known))};
}

Result<Raised> find_raised(const plan::Machine& machine, const std::string& supervisor,
                           const std::string& event,
                           const std::vector<std::pair<std::string, plan::Value>>& outputs) {
    std::vector<std::string> known;
    const plan::GraphSupervisor* found = nullptr;
    plan::WatchPlace at;
    for (int level = 0; level < machine.depth(); ++level) {
        each_supervisor(machine, level,
                        [&](const plan::GraphSupervisor& one, const plan::WatchPlace& place) {
                            if (machine.watch_at(place) == 0) return;
                            known.push_back(one.name);
                            if (one.name != supervisor || found) return;
                            found = &one;
                            at = place;
                        });
    }
    if (!found) {
        return Error{Code::NotFound, fmt::format("no supervisor \"{}\" watches now; {}", supervisor,
                                                 hint_for(supervisor, known))};
    }
    const int stopping = machine.stopping_level();
    if (stopping >= 0 && at.level >= stopping) {
        return Error{
            Code::Refused,
            fmt::format("what {} watches is being stopped already; continue first", supervisor)};
    }
    plan::Given given = TRY(make_given(*found->of, event, outputs));
    return Raised{machine.watch_at(at), std::move(given)};
}

}  // namespace vagus::run
