// Formulas: what feeds the inputs of actors and supervisors, and what a person asks a debugger
// (docs/plans.md, rules P8 to P10; all operators and functions: docs/formulas.md).
//
//     const Formula formula = parse_formula("if(far, speed * 2, 0) + 1").value();
//     const Result<Value> value = formula.evaluate(values);  // one Value for each of names()
//
// A formula is kept as steps for a small stack machine, so that evaluating needs no recursion,
// however long the formula is. What need not be evaluated is jumped over:
//
//     a or b         a Or(2) b Truth                 Or: a holds: leaves true, goes behind Truth
//     if(c, a, b)    c Branch(2) a Else(1) b EndIf   Branch: c does not hold: goes to b
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plan/formula_words.hpp"
#include "plan/value.hpp"

namespace vagus::plan {

// Parentheses, functions, `not` and unary minuses together (P8a).
constexpr int kFormulaDepthMax = 256;
constexpr size_t kFormulaBytesMax = 64 * 1024;  // of one formula

class Formula {
public:
    // A formula that is one constant: a JSON number or boolean in a plan file.
    explicit Formula(Value constant);

    // The variables in it, in order of first appearance.
    const std::vector<std::string>& names() const { return names_; }

    // With the values of names(), in that order. The Error says what failed, without a place (P9).
    Result<Value> evaluate(std::span<const Value> values) const;

    // The type of the result, given the types of names(). An Error: an object where none can be.
    Result<Type> type(std::span<const Type> types) const;

    // The name, if the formula is nothing but one variable.
    const std::string* single_name() const;

    // The texts that variables are compared with by == or !=, on either side, in their order.
    struct ComparedText {
        size_t name = 0;  // index in names()
        std::string text = {};
        friend bool operator==(const ComparedText&, const ComparedText&) = default;
    };
    std::vector<ComparedText> compared_texts() const;

private:
    friend class FormulaParser;
    Formula() = default;

    struct Step {
        FormulaOp op;
        uint32_t index =
            0;  // of a constant, name or function; number of an `if`; where a jump goes
        uint32_t count = 0;  // of a function's arguments
    };
    struct Types {
        Type result;
        std::vector<Type> of_ifs;  // by the numbers of their EndIf
    };
    class Evaluator;
    class Typist;

    Result<Types> types_of(std::span<const Type> types) const;

    std::vector<Step> steps_;  // operands before their operator
    std::vector<Value> constants_;
    std::vector<std::string> names_;
    uint32_t ifs_ = 0;
};

// The Error's sentence says what was expected where (a position counted in bytes from 1), and what
// to write instead of what other languages have.
Result<Formula> parse_formula(std::string_view text);

// [A-Za-z_][A-Za-z0-9_]* (P1).
bool is_name(std::string_view text);
// The same, and none of reserved_words().
bool is_variable_name(std::string_view text);

}  // namespace vagus::plan
