// Phase 3: do the sizes of vectors fit? (docs/spec/aesl-language.md, section 3.5) The parser has
// computed the size of each expression; here the clashes are reported, in text order. A statement
// with a mistake is marked as bad, so that later phases leave it alone.
#pragma once

#include "aesl/diagnostics.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

void check_sizes(Tree& tree, Diagnostics& diagnostics);

// The same for one expression; false if something was reported.
bool check_sizes_of(const Tree& tree, NodeId expression, Diagnostics& diagnostics);

}  // namespace vagus::aesl
