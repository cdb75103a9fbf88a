// What the files of the machine share among themselves. Nobody else includes this.
#pragma once

#include "isa/isa.hpp"
#include "vm/vm.hpp"

namespace vagus {
namespace vm {

// Sends a message of a node. All their types are 0x90.., so the low byte says which: that is
// smaller wherever this is called.
void report_low(Vm& vm, uint8_t type, const uint16_t* words, uint8_t count);
inline void report(Vm& vm, wire::MessageType type, const uint16_t* words, uint8_t count) {
    report_low(vm, static_cast<uint8_t>(type), words, count);
}
void report_state(Vm& vm);

// The slot of the breakpoint at `pc`; breakpoint_count if there is none.
uint16_t find_breakpoint(const Vm& vm, uint16_t pc);

// How many of the `count` words from `start` are inside a memory of `size` words.
uint16_t count_inside(uint16_t size, uint16_t start, uint16_t count);

// Writes what is inside of `words` to memory[start …], drops the rest.
void store(uint16_t* memory, uint16_t size, uint16_t start, const uint16_t* words, uint16_t count);
void store_variables(Vm& vm, uint16_t start, const uint16_t* words, uint16_t count);

extern const char kStackEmpty[];

// Words of an instruction; 0 for the undefined opcode.
uint8_t words_of(uint16_t instruction);

// Executes the instruction at pc. The machine must be active.
void execute(Vm& vm);

// `a` op `b`. Raises a fault and gives 0 for a division by zero. `code` must be a BinaryOperator.
// Apart from execute(): smaller on a microcontroller than woven into it.
[[gnu::noinline]] int16_t binary(Vm& vm, uint8_t code, int16_t a, int16_t b);
int16_t unary(uint8_t code, int16_t a);

}  // namespace vm
}  // namespace vagus
