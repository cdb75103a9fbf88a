#include "run/expression.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/nearest.hpp"

namespace vagus::run {

namespace {

Result<int> slot_of(const std::string& name, const plan::GraphPlan& plan) {
    std::vector<std::string> known;
    for (const plan::GraphVariable& variable : plan.variables) {
        if (variable.name == name) return static_cast<int>(known.size());
        known.push_back(variable.name);
    }
    const plan::FormulaFunction* function = plan::find_function(name);
    const std::string near = nearest(name, known);
    const std::string advice = function ? fmt::format("the function is written {}", function->form)
                               : near.empty() ? "`where` lists those it has"
                                              : fmt::format("did you mean {}?", near);
    return Error{Code::NotFound,
                 fmt::format("the plan {} has no variable \"{}\"; {}", plan.name, name, advice)};
}

}  // namespace

Result<Expression> Expression::parse(std::string_view text, const plan::GraphPlan& plan) {
    Expression made(TRY(plan::parse_formula(text)));
    std::vector<plan::Type> types;
    for (const std::string& name : made.formula_.names()) {
        made.slots_.push_back(TRY(slot_of(name, plan)));
        types.push_back(plan.variables[static_cast<size_t>(made.slots_.back())].type);
    }
    (void)TRY(made.formula_.type(types));
    return made;
}

Result<plan::Value> Expression::evaluate(std::span<const plan::Value> values) const {
    return formula_.evaluate(values);
}

Result<bool> Expression::holds(std::span<const plan::Value> values) const {
    const plan::Value value = TRY(evaluate(values));
    const plan::Value truth = TRY(plan::convert(value, plan::Type::Bool));
    return truth.boolean();
}

}  // namespace vagus::run
