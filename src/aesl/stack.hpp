// Phase 8: how deep can the stack get? (docs/spec/aesl-language.md, section 4.9) Exact for
// expressions: max(left, 1 + right). A call of a sub takes one word; subs that call themselves are
// refused.
#pragma once

#include "aesl/code.hpp"
#include "aesl/diagnostics.hpp"
#include "aesl/target.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

// The deepest stack of the whole program in words.
int32_t check_stack(const Tree& tree, const Code& code, const Target& target,
                    Diagnostics& diagnostics);

}  // namespace vagus::aesl
