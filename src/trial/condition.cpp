#include "trial/condition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/nearest.hpp"
#include "trial/plan_names.hpp"

namespace vagus::trial {

namespace {

using Name = Condition::Name;

// What to write instead; `otherwise` if nothing is near.
std::string advice_for(const std::string& name, std::vector<std::string> known,
                       const std::string& otherwise) {
    for (const Signal& one : signals()) known.emplace_back(one.name);
    const plan::FormulaFunction* const function = plan::find_function(name);
    if (function != nullptr) return fmt::format("the function is written {}", function->form);
    const std::string near = nearest(name, known);
    return near.empty() ? otherwise : fmt::format("did you mean {}?", near);
}

Error no_such_name(const std::string& name, const plan::GraphPlan& plan) {
    std::vector<std::string> known;
    for (const plan::GraphVariable& one : plan.variables) known.push_back(one.name);
    return {Code::NotFound,
            fmt::format("there is no \"{}\" in the plan {}, and no signal of that name; {}", name,
                        plan.name,
                        advice_for(name, std::move(known),
                                   "write a variable of the plan, or a signal of `vagus test "
                                   "--signals`"))};
}

// A script's variable is asked for as a word of its node.
Error no_such_signal(const Name& name) {
    return {Code::NotFound,
            fmt::format("there is no plan, and no signal \"{}\"; {}", name.variable,
                        advice_for(name.variable, {},
                                   fmt::format("write node(\"NODE\", \"{}\") for a variable of a "
                                               "script, or a signal of `vagus test --signals`",
                                               name.variable)))};
}

// Without a plan: what is of one.
Error of_a_plan(const Name& name) {
    return {Code::Refused,
            fmt::format("\"{}\" is of a plan, and there is none; write a signal of the world, as "
                        "contact, event or node(\"NODE\", \"NAME\")",
                        name.shown)};
}

Status bind_variable(Name& name, const plan::GraphPlan* plan, bool is_asked_for) {
    if (plan == nullptr) return is_asked_for ? of_a_plan(name) : no_such_signal(name);
    name.slot = plan::find_variable(*plan, name.variable);
    if (name.slot < 0) return no_such_name(name.variable, *plan);
    return Status::done();
}

Status bind_signal(const Name& name, const plan::GraphPlan* plan, bool has_world) {
    if (plan == nullptr) {
        return name.signal->id == SignalId::Actor ? of_a_plan(name) : Status::done();
    }
    if (plan::find_variable(*plan, name.shown) >= 0) {
        return Error{Code::BadInput,
                     fmt::format("\"{0}\" is a signal, and a variable of the plan {1} too; write "
                                 "variable(\"{0}\") for that one, or rename it",
                                 name.shown, plan->name)};
    }
    if (name.signal->of_world && !has_world) {
        return Error{
            Code::Refused,
            fmt::format("\"{}\" is of a robot in a world; give the test a \"world\"", name.shown)};
    }
    return Status::done();
}

plan::Type type_of(const Name& name, const plan::GraphPlan* plan) {
    if (name.signal != nullptr) return name.signal->type;
    if (name.of == Name::Of::Word) return plan::Type::Int;
    return plan->variables[static_cast<size_t>(name.slot)].type;
}

// ---- texts that signals are compared with ----

bool is_one_of(std::string_view name, const std::vector<std::string>& names) {
    return std::ranges::find(names, name) != names.end();
}

// The signal has the actor's name alone, whatever plan it is in.
Status check_actor(const std::string& text, const plan::Graph& graph) {
    const std::vector<std::string> actors = actors_of(graph);
    if (is_one_of(text, actors)) return Status::done();
    const std::string last = text.substr(text.rfind('/') + 1);
    return Error{Code::NotFound, fmt::format("the plan has no actor \"{}\"; {}", text,
                                             known_instead(last, actors))};
}

Status check_event(const std::string& text, const plan::Graph& graph) {
    const std::vector<std::string> events = events_of(graph);
    if (is_one_of(text, events)) return Status::done();
    const std::string what =
        is_one_of(text, states_of(graph))
            ? fmt::format("\"{}\" is a state of an actor, not an event of a supervisor", text)
            : fmt::format("no supervisor of the plan raises \"{}\"", text);
    return Error{Code::NotFound, what + "; " + known_instead(text, events)};
}

}  // namespace

Result<Condition> Condition::parse(std::string_view text) {
    Condition made(TRY(plan::WordFormula::parse(text)));
    for (const plan::WordFormula::Name& name : made.formula_.names()) {
        made.names_.push_back({name});
    }
    return made;
}

// '' is between two actors, or no event.
Status Condition::check_texts(const plan::Graph& graph) const {
    for (const auto& [name, text] : formula_.compared_texts()) {
        const Signal* const signal = names_[name].signal;
        if (signal == nullptr || text.empty()) continue;
        if (signal->id == SignalId::Actor) TRY(check_actor(text, graph));
        if (signal->id == SignalId::Event) TRY(check_event(text, graph));
    }
    return Status::done();
}

Status Condition::check_events(const std::vector<std::string>& known) const {
    for (const auto& [name, text] : formula_.compared_texts()) {
        const Signal* const signal = names_[name].signal;
        const bool is_event = signal != nullptr && signal->id == SignalId::Event;
        if (!is_event || text.empty() || is_one_of(text, known)) continue;
        return Error{Code::NotFound,
                     fmt::format("no script on the robot's bus knows an event \"{}\"; {}", text,
                                 known_instead(text, known))};
    }
    return Status::done();
}

Status Condition::bind(const plan::Graph& graph, bool has_world) {
    TRY(bind_names(&graph.plans.front(), has_world));
    return check_texts(graph);
}

Status Condition::bind_without_plan() {
    return bind_names(nullptr, true);
}

// `plan` is nullptr without one.
Status Condition::bind_names(const plan::GraphPlan* plan, bool has_world) {
    std::vector<plan::Type> types;
    for (Name& name : names_) {
        const bool is_asked_for = name.of == Name::Of::Variable;
        if (name.of == Name::Of::Unknown) {
            name.signal = find_signal(name.variable);
            if (name.signal == nullptr) name.of = Name::Of::Variable;
        }
        if (name.signal != nullptr) TRY(bind_signal(name, plan, has_world));
        if (name.of == Name::Of::Variable) TRY(bind_variable(name, plan, is_asked_for));
        if (name.of == Name::Of::Word && !has_world) {
            return Error{Code::Refused, fmt::format("{} is of a robot in a world; give the test a "
                                                    "\"world\"",
                                                    name.shown)};
        }
        types.push_back(type_of(name, plan));
    }
    (void)TRY(formula_.type(types));
    return Status::done();
}

bool Condition::uses(SignalId signal) const {
    return std::ranges::any_of(names_, [signal](const Name& name) {
        return name.signal != nullptr && name.signal->id == signal;
    });
}

}  // namespace vagus::trial
