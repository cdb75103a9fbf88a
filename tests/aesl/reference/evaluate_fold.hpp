// What is known of an expression before the program runs (aesl-language.md, section 3.6), asked
// again each time and answered from the tree alone. For tests only.
#pragma once

#include <cstdint>
#include <optional>

#include "aesl/tree.hpp"
#include "reference/outcome.hpp"

namespace vagus::aesl {

// Arithmetic of the folder: 32 bits, wrapping. Nothing for a division by 0.
std::optional<int32_t> fold_binary(isa::BinaryOperator op, int32_t left, int32_t right);
// Arithmetic of the machine: 16 bits. Nothing for a division by 0.
std::optional<int16_t> run_binary(isa::BinaryOperator op, int16_t left, int16_t right);
int32_t fold_unary(isa::UnaryOperator op, int32_t value);

// Where element `k` of a tuple stands: the child, and the element of it.
struct TupleElement {
    NodeId child;
    int k;
};
TupleElement tuple_element(const Tree& tree, NodeId tuple, int k);

// The number that element `k` of the expression folds to (rules 1 to 6), if it does.
std::optional<int32_t> constant(const Tree& tree, NodeId expression, int k);

// Whether nothing is left of a statement or block after folding (rules 8 to 10).
bool is_empty(const Tree& tree, NodeId statement);
// The same for an `if` from one of its clauses on, or its else block: an elseif is an `if` of its
// own in the else part (section 4.6).
bool is_if_empty(const Tree& tree, NodeId clause);

// The first error of phase 7 in the block: rules 3, 4 and 9.
std::optional<CompileError> folding_error(const Tree& tree, NodeId block);

}  // namespace vagus::aesl
