// What a person or a studio asks about the variables of a plan: a formula (docs/formulas.md) and
// where its variables are.
//
//     const Result<Expression> near = Expression::parse("distance < walldist / 2", plan);
//     near.value().evaluate(values);            // one Value for each of slots()
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plan/formula.hpp"
#include "plan/graph.hpp"

namespace vagus::run {

class Expression {
public:
    // Over the variables of this plan. The Error names what is wrong, and the nearest name.
    static Result<Expression> parse(std::string_view text, const plan::GraphPlan& plan);

    // The variables in it.
    const std::vector<int>& slots() const { return slots_; }
    // With the values of slots(), in that order.
    Result<plan::Value> evaluate(std::span<const plan::Value> values) const;
    // The value as a bool (P11).
    Result<bool> holds(std::span<const plan::Value> values) const;

private:
    explicit Expression(plan::Formula formula) : formula_(std::move(formula)) {}

    plan::Formula formula_;
    std::vector<int> slots_;
};

}  // namespace vagus::run
