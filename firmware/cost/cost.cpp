// What each instruction of the machine costs on a processor, at worst: for every opcode the
// costliest of its forms is executed, alone, and what the board counted is printed.
// tools/firmware_cost makes the table of docs/firmware.md from it.
#include <stdint.h>

#include "isa/isa.hpp"
#include "vm/vm.hpp"

// Of the board: avr.cpp counts cycles, cortex_m.cpp what one instruction takes in the emulator.
void board_begin();
uint32_t board_now();
void board_print(char c);
void board_exit();

namespace {

namespace vm = vagus::vm;
namespace isa = vagus::isa;
using isa::instruction;
using isa::Opcode;

constexpr uint16_t kStack = 32;
constexpr uint16_t kAtTop = 30;  // values on the stack before each instruction

uint16_t bytecode[16];
int16_t variables[16];
int16_t stack[kStack];
uint16_t breakpoints[vm::kBreakpointsMax];

void send(vm::Vm&, uint16_t, const uint16_t*, uint16_t) {}
void send_variables(vm::Vm&, uint16_t, uint16_t) {}
void send_error(vm::Vm&, const char*) {}
void native(vm::Vm& machine, uint16_t) {
    (void)vm::pop(machine);
}
void notify(vm::Vm&, vm::Notice) {}

const vm::Host kHost = {send, send_variables, send_error, native, notify};
const vm::Config kConfig = {1,         16,    16,          kStack, 8,      bytecode,
                            variables, stack, breakpoints, &kHost, nullptr};

struct Case {
    uint16_t words[3];
    int16_t below;  // the two values on top
    int16_t top;
};

uint16_t op(Opcode opcode, uint16_t argument) {
    return instruction(opcode, argument);
}

void print_number(uint32_t number) {
    char digits[10];
    uint8_t count = 0;
    do {
        digits[count++] = static_cast<char>('0' + number % 10);
        number /= 10;
    } while (number > 0);
    while (count > 0) board_print(digits[--count]);
}

void prepare(vm::Vm& machine, const Case& test) {
    for (uint8_t i = 0; i < 3; ++i) bytecode[3 + i] = test.words[i];
    machine.flags = vagus::wire::kFlagActive;
    machine.pc = 3;
    machine.depth = kAtTop;
    stack[kAtTop - 2] = test.below;
    stack[kAtTop - 1] = test.top;
}

uint32_t cost_of_run(vm::Vm& machine) {
    const uint32_t began = board_now();
    (void)vm::run(machine, 1);
    return board_now() - began;
}

// The run of a machine that has nothing to do, and the clock, are no part of an instruction.
uint32_t cost(vm::Vm& machine, const Case& test) {
    prepare(machine, test);
    machine.flags = 0;
    const uint32_t idle = cost_of_run(machine);
    prepare(machine, test);
    return cost_of_run(machine) - idle;
}

// Of all the operators the one that costs most, with values that make it do so.
uint32_t worst_operator(vm::Vm& machine, Opcode opcode, uint16_t count) {
    const int16_t values[] = {0x7fff, -0x7fff, 31, 15, 7, 1, 0x5555};
    uint32_t most = 0;
    for (uint16_t i = 0; i < count; ++i) {
        for (const int16_t below : values) {
            for (const int16_t top : values) {
                const uint32_t found = cost(machine, {{op(opcode, i), 2, 0}, below, top});
                if (found > most) most = found;
            }
        }
    }
    return most;
}

void print_line(uint8_t number, uint32_t found) {
    print_number(number);
    board_print(' ');
    print_number(found);
    board_print('\n');
}

void measure(vm::Vm& machine) {
    const Case cases[] = {{{op(Opcode::Stop, 0), 0, 0}, 0, 0},
                          {{op(Opcode::SmallImm, 0x801), 0, 0}, 0, 0},
                          {{op(Opcode::LargeImm, 0), 0x1234, 0}, 0, 0},
                          {{op(Opcode::Load, 15), 0, 0}, 0, 0},
                          {{op(Opcode::Store, 15), 0, 0}, 0, 1},
                          {{op(Opcode::LoadInd, 4), 8, 0}, 0, 7},
                          {{op(Opcode::StoreInd, 4), 8, 0}, 5, 7},
                          {{0, 0, 0}, 0, 0},
                          {{0, 0, 0}, 0, 0},
                          {{op(Opcode::Jump, 0xfff), 0, 0}, 0, 0},
                          {{0, 0, 0}, 0, 0},
                          {{op(Opcode::Emit, 5), 4, 8}, 0, 0},
                          {{op(Opcode::Native, 0), 0, 0}, 0, 0},
                          {{op(Opcode::SubCall, 3), 0, 0}, 0, 0},
                          {{op(Opcode::SubRet, 0), 0, 0}, 0, 3}};
    for (uint8_t number = 0; number < 15; ++number) {
        const Opcode opcode = static_cast<Opcode>(number);
        if (opcode == Opcode::Unary) {
            print_line(number, worst_operator(machine, opcode, isa::kUnaryOperatorCount));
        } else if (opcode == Opcode::Binary || opcode == Opcode::Branch) {
            print_line(number, worst_operator(machine, opcode, isa::kBinaryOperatorCount));
        } else {
            print_line(number, cost(machine, cases[number]));
        }
    }
}

}  // namespace

int main() {
    vm::Vm machine;
    board_begin();
    vm::init(machine, kConfig);
    measure(machine);
    board_exit();
    return 0;
}
