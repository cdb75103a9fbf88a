// The node that `vagus node` is without a description, and that scripts are compiled for where none
// is given: the dummy node of docs/spec/aseba-wire-and-vm.md, section 5.1.
#pragma once

#include <string>
#include <vector>

#include "aesl/target.hpp"

namespace vagus::session {

// Variables id, source, args[32], _productId, timer.period; local event timer; the 30 standard
// natives; 512 words of bytecode, 1060 of variables, 64 of stack.
aesl::Target standard_target(std::string name);

// The list of src/node/natives.def as a Target has it.
std::vector<aesl::NativeFunction> standard_natives();

}  // namespace vagus::session
