// The bytecode machine of a node, with its debugger inside (docs/spec/aseba-wire-and-vm.md,
// sections 2.3 and 3). Freestanding C++14: no heap, no library, no globals; any number of machines
// may live in one program.
//
//     int16_t variables[600], stack[32];
//     uint16_t bytecode[1500], breakpoints[kBreakpointsMax];
//     const Config config = {3,         1500,  600,         32,    32,   bytecode,
//                            variables, stack, breakpoints, &host, &node};
//     Vm vm;
//     init(vm, config);
//
//     receive(vm, type, words, count);  // a command from the bus: SetBytecode, Run, Step …
//     receive_event(vm, source, type, arguments, count);  // a user event from the bus
//     local_event(vm, 0);  // the node's own: the first local event has happened
//     run(vm, 1000);       // then: at most 1000 instructions, never blocks
//
// The machine is safe by itself: whatever bytecode it holds and whatever messages come, it reads
// and writes only the four memories of its Config. A script that tries more is stopped with
// NodeSpecificError, as by any other fault.
//
// It does not know: time, bytes and frames, the node's description, which natives exist. It asks
// its Host.
#pragma once

#include <stdint.h>

#include "isa/flash.hpp"
#include "wire/protocol.hpp"

namespace vagus {
namespace vm {

struct Vm;

constexpr uint16_t kBreakpointsMax = 16;

// Where a user event leaves its traces in the variables (section 3.10).
constexpr uint16_t kSourceAddress = 1;
constexpr uint16_t kArgumentsAddress = 2;

// What the machine tells its surroundings, so that they can do their part.
enum class Notice : uint8_t {
    Reset,          // Reset or SetBytecode: flags are set, the init event has not been started yet
    Run,            // the Run command, after its answer
    WriteBytecode,  // keep the bytecode over a restart
    Reboot,         // restart into the boot loader
    Sleep,          // SuspendToRam
};

// What the surroundings do for the machine. All five must be there; none may call receive,
// receive_event, local_event, start_event or run of the same machine. Pointers are borrowed for the
// call.
struct Host {
    // Sends a message of `count` words. `type` is a wire::MessageType, or the number of a user
    // event.
    void (*send)(Vm& vm, uint16_t type, const uint16_t* words, uint16_t count);
    // Sends Variables: `start`, then the `count` variables from there, in as many messages as
    // needed (D22); at least one, so that each question gets an answer.
    void (*send_variables)(Vm& vm, uint16_t start, uint16_t count);
    // Sends NodeSpecificError: vm.pc, then `text`, which ends with '\0' and is in flash on an AVR:
    // see flash_read().
    void (*send_error)(Vm& vm, const char* text);
    // Calls native `id`, which pops its arguments: see "For natives" below. Raises a fault for an
    // id that it lacks.
    void (*native)(Vm& vm, uint16_t id);
    void (*notify)(Vm& vm, Notice notice);
};

// What never changes while the machine runs. Sizes are in words; the memories must not overlap.
struct Config {
    uint16_t id;             // of the node, at first
    uint16_t bytecode_size;  // at least 1
    uint16_t variables_size;
    uint16_t stack_size;
    uint16_t arguments_capacity;  // size of the third described variable, usually 32
    uint16_t* bytecode;
    int16_t* variables;
    int16_t* stack;
    uint16_t* breakpoints;  // kBreakpointsMax words
    const Host* host;
    void* owner;  // for the host; the machine does not touch it
};

// What changes, beside the four memories.
struct Vm {
    const Config* config;
    uint16_t id;     // of the node: commands to others are ignored. As in the Config, unless
                     // the surroundings give it another before it starts
    uint16_t flags;  // wire::kFlagActive, kFlagStep, kFlagRunning
    uint16_t pc;     // index into the bytecode
    uint16_t depth;  // words on the stack; the top is stack[depth - 1]
    uint16_t breakpoint_count;  // breakpoints[0 … breakpoint_count - 1] are set
};

// Makes a fresh machine: idle, in running mode, no program, no breakpoints, all variables 0
// (section 3.1). The bytecode beyond its first word is left as it is.
void init(Vm& vm, const Config& config);

// Obeys a command (0xa001 … 0xa00f of section 2.3). `words` is the payload, destination first; an
// odd last byte does not count. Ignores commands to other nodes, other types, and commands that are
// too short. What a command names beyond the memories is ignored, too. Answers go to Host::send
// before this returns.
void receive(Vm& vm, uint16_t type, const uint16_t* words, uint16_t count);

// A user event has come from the bus (section 3.6): stores source and arguments, then starts the
// handler, if there is one. Dropped whole while the machine is paused inside an event.
void receive_event(Vm& vm, uint16_t source, uint16_t type, const uint16_t* arguments,
                   uint16_t count);

// The node's local event `index` (counted from 0) has happened: starts its handler, if there is
// one. Ignored while the machine is paused inside an event.
void local_event(Vm& vm, uint16_t index);

// Starts the handler of `event`, whatever the machine is doing: a running one is killed, and said
// to be. Gives false, and changes nothing, if the program has none. For nodes that start a program
// by themselves: isa::kInitEvent.
bool start_event(Vm& vm, uint16_t event);

// Where the program's handler for `event` starts; 0 if there is none. For filters of bus drivers
// (section 3.9).
[[gnu::warn_unused_result]] uint16_t event_address(const Vm& vm, uint16_t event);

// Goes on with the running event: until it ends, a breakpoint, a fault, or `limit` instructions.
// Gives the number of instructions executed; 0 when there is nothing to run.
uint16_t run(Vm& vm, uint16_t limit);

// An event is being executed and not yet finished.
inline bool is_active(const Vm& vm) {
    return (vm.flags & wire::kFlagActive) != 0;
}
// Paused inside an event: events are dropped.
inline bool is_paused_in_event(const Vm& vm) {
    constexpr uint16_t kBoth = wire::kFlagActive | wire::kFlagStep;
    return (vm.flags & kBoth) == kBoth;
}

// ---- For natives (section 4.1) ----
//
// A native pops all its arguments exactly once, also when it then fails: first the addresses of its
// arguments in their order, then the sizes. It turns addresses into pointers when it knows the
// sizes:
//
//     void copy(Vm& vm) {
//         const uint16_t dest = pop(vm);  // one statement each: the order matters
//         const uint16_t src = pop(vm);
//         const uint16_t size = pop(vm);
//         int16_t* to = memory(vm, dest, size);
//         const int16_t* from = memory(vm, src, size);
//         if (!to || !from) return;  // the fault has been raised
//         for (uint16_t i = 0; i < size; ++i) to[i] = from[i];
//     }

// Takes the top of the stack. On an empty stack: raises a fault, gives 0.
uint16_t pop(Vm& vm);

// The `size` variables from `address`. Raises a fault and gives nullptr if they are not all inside
// the variables, and gives nullptr after any fault of this instruction.
[[gnu::warn_unused_result]] int16_t* memory(Vm& vm, uint16_t address, uint16_t size);

// Their rare cases.
uint16_t pop_from_empty_stack(Vm& vm);
int16_t* no_memory(Vm& vm);

// Faults: the script is stopped (flags become Step), the message is sent with the address of the
// instruction.
void raise_division_by_zero(Vm& vm);
void raise_out_of_bounds(Vm& vm, uint16_t size, uint16_t index);
// `text`: at most 255 bytes, ends with '\0', in flash on an AVR (VAGUS_FLASH_TEXT). Also for the
// glue of a node, at any time.
void raise_node_error(Vm& vm, const char* text);

// A native asks some ten times: on a computer the calls took longer than what is done there.
inline uint16_t pop(Vm& vm) {
    if (vm.depth == 0) return pop_from_empty_stack(vm);
    return static_cast<uint16_t>(vm.config->stack[--vm.depth]);
}

inline int16_t* memory(Vm& vm, uint16_t address, uint16_t size) {
    const uint16_t variables_size = vm.config->variables_size;
    const bool inside = address <= variables_size && size <= variables_size - address;
    if (!inside || !is_active(vm)) return no_memory(vm);
    return vm.config->variables + address;
}

}  // namespace vm
}  // namespace vagus
