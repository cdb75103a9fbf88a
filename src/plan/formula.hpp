// Formulas: what feeds the inputs of actors and supervisors (docs/plans.md, rules P8 to P10).
//
//     const Formula formula = parse_formula("speed * 2 + 1").value();
//     const Result<Value> value = formula.evaluate(values);  // one Value for each of names()
//
// A formula is kept as steps for a small stack machine, so that evaluating needs no recursion,
// however long the formula is.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plan/value.hpp"

namespace vagus::plan {

constexpr int kFormulaDepthMax = 256;           // parentheses and unary minuses together (P8a)
constexpr size_t kFormulaBytesMax = 64 * 1024;  // of one formula
constexpr size_t kTextBytesMax = 1u << 20;      // of one string that a formula makes

enum class FormulaOp : uint8_t {
    Constant,
    Variable,
    Negate,
    Add,
    Subtract,
    Join,
    Multiply,
    Divide,
    Modulo
};

class Formula {
public:
    // A formula that is one constant: a JSON number or boolean in a plan file.
    explicit Formula(Value constant);

    // The variables in it, in order of first appearance.
    const std::vector<std::string>& names() const { return names_; }

    // With the values of names(), in that order. The Error says what failed, without a place (P9).
    Result<Value> evaluate(std::span<const Value> values) const;

    // The type of the result, given the types of names(). A type error of an object as an operand
    // gives no type.
    std::optional<Type> type(std::span<const Type> types) const;

    // The name, if the formula is nothing but one variable.
    const std::string* single_name() const;

private:
    friend class FormulaParser;
    Formula() = default;

    struct Step {
        FormulaOp op;
        uint32_t index = 0;  // of a constant or a name
    };

    std::vector<Step> steps_;  // operands before their operator
    std::vector<Value> constants_;
    std::vector<std::string> names_;
};

// The Error's sentence says what was expected where (a position counted in bytes from 1).
Result<Formula> parse_formula(std::string_view text);

// [A-Za-z_][A-Za-z0-9_]* (P1).
bool is_name(std::string_view text);

// One operation on values (P9), for those who compute like formulas do.
Result<Value> apply(FormulaOp op, const Value& left, const Value& right);

}  // namespace vagus::plan
