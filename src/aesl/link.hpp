// Phase 9: the sections of a program to one image with its event table (docs/spec/aesl-language.md,
// section 4.2).
#pragma once

#include "aesl/code.hpp"
#include "aesl/diagnostics.hpp"
#include "aesl/program.hpp"
#include "aesl/target.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

// Event table; events by id; subs in order of declaration. `used.stack` is left to the caller.
Program link(const Tree& tree, const Code& code, const Target& target, Diagnostics& diagnostics);

}  // namespace vagus::aesl
