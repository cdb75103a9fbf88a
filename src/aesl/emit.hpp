// Phase 7 and the words: statements to bytecode, folding on the way (docs/spec/aesl-language.md,
// sections 3.6 rules 8 to 10, 4.3 to 4.8, 4.11).
//
// Also runs over programs with mistakes, to find those that only folding shows (division by zero,
// endless loops); what comes back is then of no use.
#pragma once

#include "aesl/code.hpp"
#include "aesl/diagnostics.hpp"
#include "aesl/target.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

Code emit(const Tree& tree, const Target& target, Diagnostics& diagnostics);

}  // namespace vagus::aesl
