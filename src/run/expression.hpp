// What a person or a studio asks about the variables of a plan: a formula, or two formulas with an
// operator of comparison between them (formulas of plans have none).
//
//     const Result<Expression> near = Expression::parse("distance < walldist / 2", plan);
//     near.value().evaluate(values)             // one Value for each of slots()
#pragma once

#include <optional>
#include <span>
#include <string>
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
    // With the values of slots(), in that order. A comparison gives a bool.
    Result<plan::Value> evaluate(std::span<const plan::Value> values) const;
    // The value as a bool (P11).
    Result<bool> holds(std::span<const plan::Value> values) const;

private:
    explicit Expression(plan::Formula left) : left_(std::move(left)) {}

    plan::Formula left_;
    std::string op_;  // empty: no comparison
    std::optional<plan::Formula> right_;
    std::vector<int> slots_;  // those of left_ first
};

}  // namespace vagus::run
