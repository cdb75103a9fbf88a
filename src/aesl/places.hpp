// Phases 4 and 5: does each constant index lie in its array, can each left side be assigned to, is
// there room for the intermediate values of assignments? (docs/spec/aesl-language.md, sections 3.2,
// 3.5, 4.5)
#pragma once

#include "aesl/diagnostics.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

// In text order: first the sizes under `++` and `--`, then all else. Marks statements with a
// mistake as bad.
void check_places(Tree& tree, Diagnostics& diagnostics);

// The element or slice with which an expression begins, not what is in its index: all that the
// reference looks at while it reads arguments. False if something was reported.
bool check_first_place(const Tree& tree, NodeId expression, Diagnostics& diagnostics);

// Whether the right side of an assignment of several words must be complete before the left side is
// changed: it is if the variable on the left occurs in it (section 4.4).
bool overlaps(const Tree& tree, const Node& assignment);

}  // namespace vagus::aesl
