// The same random bytecode on every processor: this program feeds the machine seeded nonsense and
// half-sense, and prints a checksum over all that can be seen after every instruction. It must be
// the same on the computer at the desk, on a Cortex-M0 and on an AVR, where int has 16 bits and the
// compiler is another. tools/firmware_selftest compares.
#include <stdint.h>

#include "isa/isa.hpp"
#include "vm/vm.hpp"

// Of the board: see host.cpp, cortex_m0.cpp, avr.cpp.
void board_print(char c);
void board_exit();

namespace {

namespace vm = vagus::vm;
namespace isa = vagus::isa;
namespace wire = vagus::wire;

constexpr uint16_t kPrograms = 400;
constexpr uint16_t kInstructions = 60;
constexpr uint16_t kBytecode = 64;
constexpr uint16_t kVariables = 40;
constexpr uint16_t kStack = 8;

uint16_t bytecode[kBytecode];
int16_t variables[kVariables];
int16_t stack[kStack];
uint16_t breakpoints[vm::kBreakpointsMax];

uint32_t checksum = 2166136261u;  // FNV-1a over words
void mix(uint16_t word) {
    checksum = (checksum ^ word) * 16777619u;
}

uint32_t random_state = 1;
uint16_t random_word() {  // xorshift32 (Marsaglia 2003)
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return static_cast<uint16_t>(random_state >> 8);
}
uint16_t random_below(uint16_t bound) {
    return static_cast<uint16_t>(random_word() % bound);
}

void send(vm::Vm&, uint16_t type, const uint16_t* words, uint16_t count) {
    mix(type);
    for (uint16_t i = 0; i < count; ++i) mix(words[i]);
}
void send_variables(vm::Vm&, uint16_t start, uint16_t count) {
    mix(start);
    mix(count);
}
void send_error(vm::Vm& machine, const char* text) {
    mix(machine.pc);
    for (; vagus::flash_read(text) != '\0'; ++text)
        mix(static_cast<uint8_t>(vagus::flash_read(text)));
}
void native(vm::Vm& machine, uint16_t id) {
    const uint16_t address = vm::pop(machine);
    const uint16_t size = vm::pop(machine);
    int16_t* const place = vm::memory(machine, address, size);
    if (!place) return;
    for (uint16_t i = 0; i < size; ++i) place[i] = static_cast<int16_t>(place[i] ^ id);
}
void notify(vm::Vm&, vm::Notice) {}

const vm::Host kHost = {send, send_variables, send_error, native, notify};
const vm::Config kConfig = {1,         kBytecode, kVariables,  kStack, 8,      bytecode,
                            variables, stack,     breakpoints, &kHost, nullptr};

uint16_t random_value() {
    const uint16_t edges[] = {0, 1, 0xffff, 0x7fff, 0x8000, 0x8001, 31, 32};
    return random_below(2) ? edges[random_below(8)] : random_word();
}

// Two values, an operator, a place to store: or any word at all.
void make_program() {
    bytecode[0] = 3;
    bytecode[1] = isa::kInitEvent;
    bytecode[2] = 3;
    uint16_t at = 3;
    while (at < kBytecode) bytecode[at++] = random_word();
    for (at = 3; at + 6 < kBytecode;) {
        if (random_below(12) == 0) {
            ++at;
            continue;
        }
        bytecode[at++] = isa::instruction(isa::Opcode::LargeImm, 0);
        bytecode[at++] = random_value();
        bytecode[at++] = isa::instruction(isa::Opcode::LargeImm, 0);
        bytecode[at++] = random_value();
        bytecode[at++] =
            isa::instruction(isa::Opcode::Binary, random_below(isa::kBinaryOperatorCount));
        if (random_below(3) == 0) {
            bytecode[at - 1] =
                isa::instruction(isa::Opcode::Unary, random_below(isa::kUnaryOperatorCount));
        }
        bytecode[at++] = isa::instruction(isa::Opcode::Store, random_below(kVariables));
    }
}

void mix_state(const vm::Vm& machine) {
    mix(machine.pc);
    mix(machine.flags);
    mix(machine.depth);
    for (uint16_t i = 0; i < machine.depth; ++i) mix(static_cast<uint16_t>(stack[i]));
    for (uint16_t i = 0; i < kVariables; ++i) mix(static_cast<uint16_t>(variables[i]));
}

void run_one_program(vm::Vm& machine) {
    make_program();
    const uint16_t reset[] = {1};
    vm::receive(machine, static_cast<uint16_t>(wire::MessageType::Reset), reset, 1);
    vm::receive(machine, static_cast<uint16_t>(wire::MessageType::Run), reset, 1);
    for (uint16_t i = 0; i < kInstructions && vm::run(machine, 1) > 0; ++i) mix_state(machine);
    for (uint16_t i = 0; i < kBytecode; ++i) mix(bytecode[i]);
}

}  // namespace

int main() {
    vm::Vm machine;
    vm::init(machine, kConfig);
    for (uint16_t i = 0; i < kPrograms; ++i) run_one_program(machine);
    for (int8_t shift = 28; shift >= 0; shift = static_cast<int8_t>(shift - 4)) {
        board_print("0123456789abcdef"[(checksum >> shift) & 15]);
    }
    board_print('\n');
    board_exit();
    return 0;
}
