// The operators and functions of formulas (docs/plans.md, P8 to P9c): the one list from which the
// parser, the evaluator, messages, completion and the tables of docs/formulas.md are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vagus::plan {

// One step of a formula (formula.hpp).
enum class FormulaOp : uint8_t {
    Constant,
    Variable,
    Negate,
    Add,
    Subtract,
    Join,
    Multiply,
    Divide,
    Modulo,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Not,
    And,     // decides, or drops its left side
    Or,      // likewise
    Truth,   // the right side of And and Or, as a bool
    Branch,  // after the condition of `if`
    Else,    // between its sides
    EndIf,
    Call
};

// How strongly operators bind; those of one rank go from the left.
enum class Rank : uint8_t { Or = 1, And, Not, Compare, Sum, Product, Sign };

struct FormulaOperator {
    std::string_view text;
    Rank rank;
    FormulaOp op;
    std::string_view form;  // how it is written
    std::string_view help;
};

enum class Function : uint8_t {
    If,
    Abs,
    Min,
    Max,
    Clamp,
    Sign,
    Floor,
    Ceil,
    Round,
    Sqrt,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan2
};

constexpr size_t kAnyNumber = ~size_t{0};

struct FormulaFunction {
    Function id;
    std::string_view name;
    std::string_view form;  // with its arguments, as "clamp(x, low, high)"
    size_t arguments_min;
    size_t arguments_max;  // kAnyNumber: no limit but the length of a formula
    std::string_view help;
};

// Weakest first.
std::span<const FormulaOperator> formula_operators();
// In the order of Function.
std::span<const FormulaFunction> formula_functions();

// nullptr: there is none of that name.
const FormulaFunction* find_function(std::string_view name);

// The operator of a step that is written as one, as "+"; empty for others.
std::string_view symbol_of(FormulaOp op);

// All of it as JSON, for editors (docs/formats.md, `vagus plan formulas --json`).
std::string format_formula_words_json();

// Words that no variable can have as its name (P1).
std::span<const std::string_view> reserved_words();
inline constexpr std::string_view kNotReserved = ", and not true, false, and, or, not";

}  // namespace vagus::plan
