// One instruction (docs/spec/aseba-wire-and-vm.md, sections 3.4 and 3.5). What every instruction
// must hold is checked in one place, from the one list isa/opcodes.def; the cases then check only
// what is particular to them.
#include "vm/internal.hpp"

namespace vagus {
namespace vm {
namespace {

using isa::Opcode;

VAGUS_FLASH_TEXT(kBadInstruction, "bad instruction");
VAGUS_FLASH_TEXT(kBadStack, "stack overflow");

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

// Sends `count` variables from `address` as a user event.
void emit(Vm& vm, uint16_t event, uint16_t address, uint16_t count) {
    if (count > wire::kArgumentsMax) return raise_node_error(vm, kBadInstruction);
    const int16_t* const words = memory(vm, address, count);
    if (!words) return;
    vm.config->host->send(vm, event, reinterpret_cast<const uint16_t*>(words), count);
}

}  // namespace

uint8_t words_of(uint16_t instruction) {
    return shape_of(instruction) & 3;
}

void execute(Vm& vm) {
    const Config& config = *vm.config;
    uint16_t* const code = config.bytecode + vm.pc;
    const uint16_t left = static_cast<uint16_t>(config.bytecode_size - vm.pc);
    if (vm.pc >= config.bytecode_size) return raise_node_error(vm, kBadInstruction);
    const uint16_t word = *code;
    const uint8_t shape = shape_of(word);
    const uint8_t words = shape & 3;
    const uint8_t pushed = static_cast<uint8_t>(shape >> 4);
    if (words == 0 || words > left) return raise_node_error(vm, kBadInstruction);
    const uint16_t below = static_cast<uint16_t>(vm.depth - ((shape >> 2) & 3));
    if (below > vm.depth || below + pushed > config.stack_size)
        return raise_node_error(vm, kBadStack);

    const Opcode opcode = isa::opcode_of(word);
    const uint16_t argument = isa::argument_of(word);
    const uint8_t low = static_cast<uint8_t>(word);
    int16_t* const stack = config.stack + below;
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
            index = static_cast<uint16_t>(config.stack[vm.depth - 1]);
            if (index >= code[1]) return raise_out_of_bounds(vm, code[1], index);
            // fall through
        case Opcode::Load:
        case Opcode::Store: {
            int16_t* const place = memory(vm, argument, static_cast<uint16_t>(index + 1));
            if (!place) return;
            if (pushed) {
                stack[0] = place[index];
            } else {
                place[index] = stack[0];
            }
            break;
        }
        case Opcode::Unary:
            if (low >= isa::kUnaryOperatorCount) return raise_node_error(vm, kBadInstruction);
            stack[0] = unary(low, stack[0]);
            break;
        case Opcode::Binary:
        case Opcode::Branch: {
            if (low >= isa::kBinaryOperatorCount) return raise_node_error(vm, kBadInstruction);
            const int16_t result = binary(vm, low, stack[0], stack[1]);
            if (opcode == Opcode::Binary) {
                stack[0] = result;
                break;
            }
            const uint16_t seen = word & (isa::kBranchIsWhen | isa::kBranchWasTrue);
            if (!result || seen == (isa::kBranchIsWhen | isa::kBranchWasTrue)) {
                next = static_cast<uint16_t>(vm.pc + code[1]);
            }
            *code = static_cast<uint16_t>(word & ~isa::kBranchWasTrue);
            if (result) *code = word | isa::kBranchWasTrue;
            break;
        }
        case Opcode::Jump:
            next = static_cast<uint16_t>(vm.pc + isa::signed_argument_of(word));
            break;
        case Opcode::Emit:
            emit(vm, argument, code[1], code[2]);
            if (!is_active(vm)) return;
            break;
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
    if (opcode != Opcode::Native) vm.depth = static_cast<uint16_t>(below + pushed);
}

}  // namespace vm
}  // namespace vagus
