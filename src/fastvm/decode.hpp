// Bytecode into cells. Nobody else includes this.
#pragma once

#include <cstdint>
#include <span>

#include "fastvm/cell.hpp"

namespace vagus::fastvm {

// The cells of `bytecode` up to the end of the program, for a machine with so many variables. What
// comes out does not depend on what branches remember in their words (isa::kBranchWasTrue). At a
// breakpoint cells leave: vm::run() stops there.
Cells decode(std::span<const uint16_t> bytecode, uint16_t variables_size,
             std::span<const uint16_t> breakpoints);

}  // namespace vagus::fastvm
