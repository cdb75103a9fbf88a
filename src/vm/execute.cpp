// One instruction (docs/spec/aseba-wire-and-vm.md, sections 3.4 and 3.5). What every instruction
// must hold is checked in one place, from the one list isa/opcodes.def; the cases then check only
// what is particular to them.
#include "vm/internal.hpp"

namespace vagus {
namespace vm {
namespace {

using isa::Opcode;

VAGUS_FLASH_TEXT(kBadPc, "pc outside bytecode");
VAGUS_FLASH_TEXT(kBadInstruction, "bad instruction");
VAGUS_FLASH_TEXT(kStackFull, "stack full");
VAGUS_FLASH_TEXT(kEventTooLong, "event too long");

// Bits 1..0 words of the instruction, 3..2 words popped, 4 words pushed. The last entry is the
// undefined opcode.
VAGUS_FLASH_TABLE(uint8_t, kShapes, 16) = {
#define OP(name, opcode, words, popped, pushed) words | popped << 2 | pushed << 4,
#include "isa/opcodes.def"
#undef OP
    0};

uint8_t shape_of(uint16_t instruction) {
    return flash_read(&kShapes[instruction >> 12]);
}

}  // namespace

uint8_t words_of(uint16_t instruction) {
    return shape_of(instruction) & 3;
}

void execute(Vm& vm) {
    const Config& config = *vm.config;
    uint16_t* const code = config.bytecode + vm.pc;
    const uint16_t left = static_cast<uint16_t>(config.bytecode_size - vm.pc);
    if (vm.pc >= config.bytecode_size) return raise_node_error(vm, kBadPc);
    const uint16_t word = *code;
    const uint8_t shape = shape_of(word);
    const uint8_t words = shape & 3;
    if (words > left) return raise_node_error(vm, kBadPc);
    if (words == 0) return raise_node_error(vm, kBadInstruction);
    const uint8_t popped = (shape >> 2) & 3;
    const int8_t growth = static_cast<int8_t>((shape >> 4) - popped);
    if (vm.depth < popped) return raise_node_error(vm, kStackEmpty);
    if (vm.depth + growth > config.stack_size) return raise_node_error(vm, kStackFull);

    const Opcode opcode = isa::opcode_of(word);
    const uint16_t argument = isa::argument_of(word);
    int16_t* const stack = config.stack + vm.depth - popped;
    uint16_t next = static_cast<uint16_t>(vm.pc + words);
    uint16_t index = 0;
    switch (opcode) {
        case Opcode::Stop:
            vm.flags &= static_cast<uint16_t>(~wire::kFlagActive);
            return;
        case Opcode::SmallImm:
            stack[0] = isa::signed_argument_of(word);
            break;
        case Opcode::LargeImm:
            stack[0] = static_cast<int16_t>(code[1]);
            break;
        case Opcode::LoadInd:
        case Opcode::StoreInd:
            index = static_cast<uint16_t>(stack[popped - 1]);
            if (index >= code[1]) return raise_out_of_bounds(vm, code[1], index);
            // fall through
        case Opcode::Load:
        case Opcode::Store: {
            int16_t* const place = memory(vm, argument, static_cast<uint16_t>(index + 1));
            if (!place) return;
            if (growth >= 0) {
                stack[0] = place[index];
            } else {
                place[index] = stack[0];
            }
            break;
        }
        case Opcode::Unary:
            if (isa::operator_of(word) >= isa::kUnaryOperatorCount)
                return raise_node_error(vm, kBadInstruction);
            stack[0] = unary(isa::operator_of(word), stack[0]);
            break;
        case Opcode::Binary:
        case Opcode::Branch: {
            if (isa::operator_of(word) >= isa::kBinaryOperatorCount)
                return raise_node_error(vm, kBadInstruction);
            const int16_t result = binary(vm, isa::operator_of(word), stack[0], stack[1]);
            if (opcode == Opcode::Binary) {
                stack[0] = result;
                break;
            }
            // A `when` that was true before is not taken again.
            if (!result || (~word & (isa::kBranchIsWhen | isa::kBranchWasTrue)) == 0) {
                next = static_cast<uint16_t>(vm.pc + code[1]);
            }
            // The memory is kept for `if` and `while` too, as the original does (3.5).
            *code = static_cast<uint16_t>(result ? word | isa::kBranchWasTrue
                                                 : word & ~isa::kBranchWasTrue);
            break;
        }
        case Opcode::Jump:
            next = static_cast<uint16_t>(vm.pc + isa::signed_argument_of(word));
            break;
        case Opcode::Emit: {
            const uint16_t count = code[2];
            if (count > wire::kArgumentsMax) return raise_node_error(vm, kEventTooLong);
            const int16_t* const arguments = memory(vm, code[1], count);
            if (!arguments) return;
            config.host->send(vm, argument, reinterpret_cast<const uint16_t*>(arguments), count);
            break;
        }
        case Opcode::Native:
            config.host->native(vm, argument);
            break;
        case Opcode::SubCall:
            stack[0] = static_cast<int16_t>(next);
            next = argument;
            break;
        case Opcode::SubRet:
            next = static_cast<uint16_t>(stack[0]);
            break;
    }
    vm.pc = next;
    vm.depth = static_cast<uint16_t>(vm.depth + growth);
}

}  // namespace vm
}  // namespace vagus
