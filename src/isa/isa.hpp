// The bytecode of Vagus (and Aseba) nodes: instruction formats and numbers, shared by compiler, VM
// and tools. The lists are opcodes.def and operators.def; this header derives the enumerations and
// says how words are packed.
//
// A program image (section 3.3): word 0 holds the length of the event vector, itself included (2n +
// 1); then n pairs of event id and start address; then code. An instruction's first word has the
// opcode in bits 15..12.
#pragma once

#include <stdint.h>

namespace vagus {
namespace isa {

enum class Opcode : uint8_t {
#define OP(name, opcode, words, popped, pushed) name = opcode,
#include "isa/opcodes.def"
#undef OP
};

enum class BinaryOperator : uint8_t {
#define BINARY(name, code, symbol) name = code,
#include "isa/operators.def"
#undef BINARY
};

enum class UnaryOperator : uint8_t {
#define UNARY(name, code, symbol) name = code,
#include "isa/operators.def"
#undef UNARY
};

// How long the lists are; codes run from 0 without gaps.
constexpr uint16_t kOpcodeCount = 0
#define OP(name, opcode, words, popped, pushed) +1
#include "isa/opcodes.def"
#undef OP
    ;
constexpr uint16_t kBinaryOperatorCount = 0
#define BINARY(name, code, symbol) +1
#include "isa/operators.def"
#undef BINARY
    ;
constexpr uint16_t kUnaryOperatorCount = 0
#define UNARY(name, code, symbol) +1
#include "isa/operators.def"
#undef UNARY
    ;

// Bits of the first word of a Branch instruction.
constexpr uint16_t kBranchIsWhen = 0x0100;  // edge-sensitive
constexpr uint16_t kBranchWasTrue =
    0x0200;  // result of the last evaluation; written by the VM, 0 in emitted code

// Event ids (section 3.3). User events are 0 … 0x7fff; the k-th local event of a node is
// kLocalEventFirst - k.
constexpr uint16_t kInitEvent = 0xffff;
constexpr uint16_t kLocalEventFirst = 0xfffe;
constexpr uint16_t kUserEventLimit = 0x8000;

// Fields of 12 bits: addresses of variables and subroutines, emitted events, natives.
constexpr uint16_t kArgumentMask = 0x0fff;
constexpr uint16_t kArgumentLimit = 0x1000;

constexpr Opcode opcode_of(uint16_t word) {
    return static_cast<Opcode>(word >> 12);
}
constexpr uint16_t argument_of(uint16_t word) {
    return static_cast<uint16_t>(word & kArgumentMask);
}
// The operator of a Unary, Binary or Branch instruction; may be none that exists.
constexpr uint8_t operator_of(uint16_t word) {
    return static_cast<uint8_t>(word & 0xff);
}
// The 12-bit argument as a signed number: -2048 … 2047.
constexpr int16_t signed_argument_of(uint16_t word) {
    return static_cast<int16_t>(static_cast<int16_t>(static_cast<uint16_t>(word << 4)) >> 4);
}
constexpr uint16_t instruction(Opcode opcode, uint16_t argument) {
    return static_cast<uint16_t>((static_cast<uint16_t>(opcode) << 12) |
                                 (argument & kArgumentMask));
}

}  // namespace isa
}  // namespace vagus
