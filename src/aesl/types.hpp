// Phase 6: numbers and conditions in their places, subs that exist (docs/spec/aesl-language.md,
// section 3.4).
//
// Where the reference checks nothing (indices, arguments of events and native functions), a
// condition counts as 0 or 1, also as an operand of arithmetic; a number where a condition is
// needed is an error there too.
#pragma once

#include "aesl/diagnostics.hpp"
#include "aesl/target.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

// In text order. Marks statements with a mistake as bad.
void check_types(Tree& tree, const Target& target, Diagnostics& diagnostics);

}  // namespace vagus::aesl
