// vm::run() for hosts: the same, several times as fast. It takes memory for the decoded program and
// some 40 kB of code, which a microcontroller does not have.
//
//     fastvm::run(vm, bytecode, 1000);  // instead of vm::run(vm, 1000)
//
// All that can be seen is the same after every run, whatever its limit: registers, stack,
// variables, bytecode, messages, calls of the Host and what they see. Instructions with
// breakpoints, and those that fault, are run by vm::run() itself.
#pragma once

#include "fastvm/bytecode.hpp"
#include "vm/vm.hpp"

namespace vagus::fastvm {

// `bytecode` must be the memory of this machine, and have had all its notices.
uint16_t run(vm::Vm& vm, Bytecode& bytecode, uint16_t limit);

}  // namespace vagus::fastvm
