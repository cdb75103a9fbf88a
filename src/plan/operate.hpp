// What the operators and functions of formulas do with values (docs/plans.md, P9 to P9c), and of
// which type their results are. Errors say what failed, without a place.
#pragma once

#include <span>

#include "base/result.hpp"
#include "plan/formula_words.hpp"
#include "plan/value.hpp"

namespace vagus::plan {

constexpr size_t kTextBytesMax = 1u << 20;  // of one string that a formula makes

// Operators with one and with two operands; not And, Or and the steps of `if`, which decide what is
// evaluated.
Result<Value> apply(FormulaOp op, const Value& operand);
Result<Value> apply(FormulaOp op, const Value& left, const Value& right);
// Not `if`.
Result<Value> apply(Function function, std::span<const Value> arguments);

// The same for types. An Error: an object where none can be.
Result<Type> type_of(FormulaOp op, Type operand);
Result<Type> type_of(FormulaOp op, Type left, Type right);
Result<Type> type_of(Function function, std::span<const Type> arguments);
// Of the sides of `if` (P9b).
Result<Type> type_of_sides(Type left, Type right);

}  // namespace vagus::plan
