#include "trial/condition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/nearest.hpp"

namespace vagus::trial {

namespace {

using Name = Condition::Name;

Error no_such_name(const std::string& name, const plan::GraphPlan& plan) {
    std::vector<std::string> known;
    for (const Signal& one : signals()) known.emplace_back(one.name);
    for (const plan::GraphVariable& one : plan.variables) known.push_back(one.name);
    const std::string near = nearest(name, known);
    const plan::FormulaFunction* const function = plan::find_function(name);
    const std::string advice =
        function != nullptr ? fmt::format("the function is written {}", function->form)
        : near.empty()      ? "write a variable of the plan, or a signal of `vagus test --signals`"
                            : fmt::format("did you mean {}?", near);
    return {Code::NotFound, fmt::format("there is no \"{}\" in the plan {}, and no signal of that "
                                        "name; {}",
                                        name, plan.name, advice)};
}

Status bind_variable(Name& name, const plan::GraphPlan& plan) {
    name.slot = plan::find_variable(plan, name.variable);
    if (name.slot < 0) return no_such_name(name.variable, plan);
    return Status::done();
}

Status bind_signal(const Name& name, const plan::GraphPlan& plan, bool has_world) {
    if (plan::find_variable(plan, name.shown) >= 0) {
        return Error{Code::BadInput,
                     fmt::format("\"{0}\" is a signal, and a variable of the plan {1} too; write "
                                 "variable(\"{0}\") for that one, or rename it",
                                 name.shown, plan.name)};
    }
    if (name.signal->of_world && !has_world) {
        return Error{
            Code::Refused,
            fmt::format("\"{}\" is of a robot in a world; give the test a \"world\"", name.shown)};
    }
    return Status::done();
}

plan::Type type_of(const Name& name, const plan::GraphPlan& plan) {
    if (name.of == Name::Of::Signal) return name.signal->type;
    if (name.of == Name::Of::Word) return plan::Type::Int;
    return plan.variables[static_cast<size_t>(name.slot)].type;
}

}  // namespace

Result<Condition> Condition::parse(std::string_view text) {
    using Of = plan::WordFormula::Name::Of;
    Condition made(TRY(plan::WordFormula::parse(text)));
    for (const plan::WordFormula::Name& name : made.formula_.names()) {
        made.names_.push_back({.shown = name.shown,
                               .of = name.of == Of::Variable ? Name::Of::Variable
                                     : name.of == Of::Word   ? Name::Of::Word
                                                             : Name::Of::Unknown,
                               .variable = name.variable,
                               .node = name.node,
                               .element = name.element});
    }
    return made;
}

Status Condition::bind(const plan::GraphPlan& plan, bool has_world) {
    std::vector<plan::Type> types;
    for (Name& name : names_) {
        if (name.of == Name::Of::Unknown) {
            name.signal = find_signal(name.variable);
            name.of = name.signal != nullptr ? Name::Of::Signal : Name::Of::Variable;
        }
        if (name.of == Name::Of::Signal) TRY(bind_signal(name, plan, has_world));
        if (name.of == Name::Of::Variable) TRY(bind_variable(name, plan));
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
