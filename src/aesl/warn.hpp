// What is legal and still probably a mistake. Works on a program without errors; the warnings that
// only folding shows (conditions that are always true, loops that never end) are reported by
// emit.cpp.
#pragma once

#include "aesl/diagnostics.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

void warn(const Tree& tree, Diagnostics& diagnostics);

}  // namespace vagus::aesl
