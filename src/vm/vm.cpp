// The machine as a whole: fresh start, events, the run loop, faults, and what natives need.
// Instructions are in execute.cpp, commands in debug.cpp.
#include "vm/vm.hpp"

#include "vm/internal.hpp"

namespace vagus {
namespace vm {

using wire::MessageType;

VAGUS_FLASH_TEXT(kStackEmpty, "stack empty");

namespace {
VAGUS_FLASH_TEXT(kBadAddress, "bad address");
}

void init(Vm& vm, const Config& config) {
    vm.config = &config;
    vm.id = config.id;
    vm.flags = 0;
    vm.pc = 0;
    vm.depth = 0;
    vm.breakpoint_count = 0;
    config.bytecode[0] = 0;
    for (uint16_t i = 0; i < config.variables_size; ++i) config.variables[i] = 0;
}

// ---- Messages ----

void report_low(Vm& vm, uint8_t type, const uint16_t* words, uint8_t count) {
    constexpr uint16_t kNodeMessages = 0x9000;
    vm.config->host->send(vm, kNodeMessages | type, words, count);
}

void report_state(Vm& vm) {
    const uint16_t words[] = {vm.pc, vm.flags};
    report(vm, MessageType::ExecutionStateChanged, words, 2);
}

uint16_t count_inside(uint16_t size, uint16_t start, uint16_t count) {
    if (start >= size) return 0;
    const uint16_t room = static_cast<uint16_t>(size - start);
    return count < room ? count : room;
}

void store(uint16_t* memory, uint16_t size, uint16_t start, const uint16_t* words, uint16_t count) {
    for (; count > 0 && start < size; --count) memory[start++] = *words++;
}

void store_variables(Vm& vm, uint16_t start, const uint16_t* words, uint16_t count) {
    store(reinterpret_cast<uint16_t*>(vm.config->variables), vm.config->variables_size, start,
          words, count);
}

// ---- Events ----

uint16_t event_address(const Vm& vm, uint16_t event) {
    const uint16_t* const code = vm.config->bytecode;
    const uint16_t last = static_cast<uint16_t>(vm.config->bytecode_size - 1);
    const uint16_t* const end = code + (code[0] < last ? code[0] : last);
    for (const uint16_t* entry = code + 1; entry < end; entry += 2) {
        if (entry[0] == event) return entry[1];
    }
    return 0;
}

bool start_event(Vm& vm, uint16_t event) {
    const uint16_t address = event_address(vm, event);
    if (address == 0) return false;
    if (is_active(vm)) report(vm, MessageType::EventExecutionKilled, &vm.pc, 1);
    vm.pc = address;
    vm.depth = 0;
    vm.flags |= wire::kFlagActive;
    if (vm.flags & wire::kFlagStep) report_state(vm);
    return true;
}

void receive_event(Vm& vm, uint16_t source, uint16_t type, const uint16_t* arguments,
                   uint16_t count) {
    if (is_paused_in_event(vm)) return;
    const uint16_t capacity = vm.config->arguments_capacity;
    store_variables(vm, kSourceAddress, &source, 1);
    store_variables(vm, kArgumentsAddress, arguments, count < capacity ? count : capacity);
    start_event(vm, type);
}

void local_event(Vm& vm, uint16_t index) {
    if (!is_paused_in_event(vm))
        start_event(vm, static_cast<uint16_t>(isa::kLocalEventFirst - index));
}

// ---- The run loop (section 3.7) ----

uint16_t find_breakpoint(const Vm& vm, uint16_t pc) {
    uint16_t slot = 0;
    while (slot < vm.breakpoint_count && vm.config->breakpoints[slot] != pc) ++slot;
    return slot;
}

uint16_t run(Vm& vm, uint16_t limit) {
    uint16_t done = 0;
    if ((vm.flags & (wire::kFlagActive | wire::kFlagStep)) != wire::kFlagActive) return 0;
    vm.flags |= wire::kFlagRunning;
    while (done < limit && is_active(vm)) {
        if (find_breakpoint(vm, vm.pc) < vm.breakpoint_count) {
            vm.flags |= wire::kFlagStep;
            report_state(vm);
            return done;
        }
        execute(vm);
        ++done;
    }
    vm.flags &= static_cast<uint16_t>(~wire::kFlagRunning);
    return done;
}

// ---- Natives and faults (sections 3.8 and 4.1) ----

uint16_t pop_from_empty_stack(Vm& vm) {
    if (is_active(vm)) raise_node_error(vm, kStackEmpty);
    return 0;
}

int16_t* no_memory(Vm& vm) {
    if (is_active(vm)) raise_node_error(vm, kBadAddress);
    return nullptr;
}

void raise_division_by_zero(Vm& vm) {
    vm.flags = wire::kFlagStep;
    report(vm, MessageType::DivisionByZero, &vm.pc, 1);
}

void raise_out_of_bounds(Vm& vm, uint16_t size, uint16_t index) {
    const uint16_t words[] = {vm.pc, size, index};
    vm.flags = wire::kFlagStep;
    report(vm, MessageType::ArrayAccessOutOfBounds, words, 3);
}

void raise_node_error(Vm& vm, const char* text) {
    vm.flags = wire::kFlagStep;
    vm.config->host->send_error(vm, text);
}

}  // namespace vm
}  // namespace vagus
