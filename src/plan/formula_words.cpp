#include "plan/formula_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/json.hpp"

namespace vagus::plan {

namespace {

constexpr FormulaOperator kOperators[] = {
    {"or", Rank::Or, FormulaOp::Or, "a or b",
     "true if one side is; the right side is evaluated only if the left one is false"},
    {"and", Rank::And, FormulaOp::And, "a and b",
     "true if both sides are; the right side is evaluated only if the left one is true"},
    {"not", Rank::Not, FormulaOp::Not, "not a", "true if a is false"},
    {"==", Rank::Compare, FormulaOp::Equal, "a == b", "true if they are equal"},
    {"!=", Rank::Compare, FormulaOp::NotEqual, "a != b", "true if they differ"},
    {"<", Rank::Compare, FormulaOp::Less, "a < b", "true if a is less than b"},
    {"<=", Rank::Compare, FormulaOp::LessOrEqual, "a <= b", "true if a is at most b"},
    {">", Rank::Compare, FormulaOp::Greater, "a > b", "true if a is greater than b"},
    {">=", Rank::Compare, FormulaOp::GreaterOrEqual, "a >= b", "true if a is at least b"},
    {"+", Rank::Sum, FormulaOp::Add, "a + b", "the sum; with a string, both as one text"},
    {"-", Rank::Sum, FormulaOp::Subtract, "a - b", "the difference"},
    {"&", Rank::Sum, FormulaOp::Join, "a & b", "both as one text"},
    {"*", Rank::Product, FormulaOp::Multiply, "a * b", "the product"},
    {"/", Rank::Product, FormulaOp::Divide, "a / b",
     "the quotient; of two ints it is cut to a whole number"},
    {"%", Rank::Product, FormulaOp::Modulo, "a % b",
     "what remains of a divided by b, with the sign of a"},
    {"-", Rank::Sign, FormulaOp::Negate, "-a", "the opposite"},
};

constexpr FormulaFunction kFunctions[] = {
    {Function::If, "if", "if(condition, a, b)", 3, 3,
     "a if the condition is true, else b; only that one is evaluated"},
    {Function::Abs, "abs", "abs(x)", 1, 1, "x without its sign"},
    {Function::Min, "min", "min(a, b, ...)", 2, kAnyNumber, "the smallest"},
    {Function::Max, "max", "max(a, b, ...)", 2, kAnyNumber, "the largest"},
    {Function::Clamp, "clamp", "clamp(x, low, high)", 3, 3, "x, but at least low and at most high"},
    {Function::Sign, "sign", "sign(x)", 1, 1, "-1, 0 or 1"},
    {Function::Floor, "floor", "floor(x)", 1, 1, "the next whole number below, an int"},
    {Function::Ceil, "ceil", "ceil(x)", 1, 1, "the next whole number above, an int"},
    {Function::Round, "round", "round(x)", 1, 1,
     "the nearest whole number, an int; a half goes away from zero"},
    {Function::Sqrt, "sqrt", "sqrt(x)", 1, 1, "the square root"},
    {Function::Sin, "sin", "sin(x)", 1, 1, "the sine of x degrees"},
    {Function::Cos, "cos", "cos(x)", 1, 1, "the cosine of x degrees"},
    {Function::Tan, "tan", "tan(x)", 1, 1, "the tangent of x degrees"},
    {Function::Asin, "asin", "asin(x)", 1, 1, "the angle with that sine, -90 to 90 degrees"},
    {Function::Acos, "acos", "acos(x)", 1, 1, "the angle with that cosine, 0 to 180 degrees"},
    {Function::Atan2, "atan2", "atan2(y, x)", 2, 2,
     "the angle of the vector (x, y), -180 to 180 degrees"},
};

constexpr std::array<std::string_view, 5> kReserved = {"true", "false", "and", "or", "not"};

}  // namespace

std::span<const FormulaOperator> formula_operators() {
    return kOperators;
}

std::span<const FormulaFunction> formula_functions() {
    return kFunctions;
}

const FormulaFunction* find_function(std::string_view name) {
    const auto* found = std::find_if(std::begin(kFunctions), std::end(kFunctions),
                                     [name](const FormulaFunction& f) { return f.name == name; });
    return found == std::end(kFunctions) ? nullptr : found;
}

std::string_view symbol_of(FormulaOp op) {
    for (const FormulaOperator& one : kOperators) {
        if (one.op == op) return one.text;
    }
    return "";
}

std::string format_formula_words_json() {
    std::string text = "{\n  \"operators\": [";
    std::string_view comma = "";
    for (const FormulaOperator& one : kOperators) {
        text += fmt::format("{}\n    {{\"text\": {}, \"form\": {}, \"help\": {}}}", comma,
                            json_quote(one.text), json_quote(one.form), json_quote(one.help));
        comma = ",";
    }
    text += "\n  ],\n  \"functions\": [";
    comma = "";
    for (const FormulaFunction& one : kFunctions) {
        const bool limited = one.arguments_max != kAnyNumber;
        text += fmt::format(
            "{}\n    {{\"name\": {}, \"form\": {}, \"arguments\": [{}, {}], \"help\": {}}}", comma,
            json_quote(one.name), json_quote(one.form), one.arguments_min,
            limited ? std::to_string(one.arguments_max) : "null", json_quote(one.help));
        comma = ",";
    }
    text += "\n  ],\n  \"words\": [";
    comma = "";
    for (const std::string_view word : kReserved) {
        text += fmt::format("{}{}", comma, json_quote(word));
        comma = ", ";
    }
    return text + "]\n}\n";
}

std::span<const std::string_view> reserved_words() {
    return kReserved;
}

}  // namespace vagus::plan
