#include "run/expression.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/nearest.hpp"
#include "plan/compare.hpp"

namespace vagus::run {

namespace {

struct Operator {
    size_t at = std::string_view::npos;
    size_t length = 0;
};

// The first comparison outside of strings.
Operator find_operator(std::string_view text) {
    char quote = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != 0) {
            if (c == quote) quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (std::string_view("=!<>").find(c) != std::string_view::npos) {
            return {i, i + 1 < text.size() && text[i + 1] == '=' ? 2u : 1u};
        }
    }
    return {};
}

Status add_slots(const plan::Formula& formula, const plan::GraphPlan& plan,
                 std::vector<int>& slots) {
    std::vector<std::string> known;
    for (const plan::GraphVariable& variable : plan.variables) known.push_back(variable.name);
    for (const std::string& name : formula.names()) {
        const auto found = std::find(known.begin(), known.end(), name);
        if (found == known.end()) {
            const std::string near = nearest(name, known);
            const std::string mend =
                near.empty() ? "`where` lists those it has" : fmt::format("did you mean {}?", near);
            return Error{Code::NotFound, fmt::format("the plan {} has no variable \"{}\"; {}",
                                                     plan.name, name, mend)};
        }
        slots.push_back(static_cast<int>(found - known.begin()));
    }
    return Status::done();
}

}  // namespace

Result<Expression> Expression::parse(std::string_view text, const plan::GraphPlan& plan) {
    const Operator found = find_operator(text);
    Expression made(TRY(plan::parse_formula(text.substr(0, found.at))));
    TRY(add_slots(made.left_, plan, made.slots_));
    if (found.length == 0) return made;
    made.op_ = std::string(text.substr(found.at, found.length));
    if (made.op_ == "=" || made.op_ == "!") {
        return Error{
            Code::BadInput,
            fmt::format("\"{}\" compares nothing; the comparisons are == != < <= > >=", made.op_)};
    }
    made.right_ = TRY(plan::parse_formula(text.substr(found.at + found.length)));
    TRY(add_slots(*made.right_, plan, made.slots_));
    return made;
}

Result<plan::Value> Expression::evaluate(std::span<const plan::Value> values) const {
    const size_t left_count = left_.names().size();
    plan::Value left = TRY(left_.evaluate(values.first(left_count)));
    if (!right_) return left;
    const plan::Value right = TRY(right_->evaluate(values.subspan(left_count)));
    const bool holds = TRY(plan::compare(left, op_, right));
    return plan::Value(holds);
}

Result<bool> Expression::holds(std::span<const plan::Value> values) const {
    const plan::Value value = TRY(evaluate(values));
    const plan::Value truth = TRY(plan::convert(value, plan::Type::Bool));
    return truth.boolean();
}

}  // namespace vagus::run
