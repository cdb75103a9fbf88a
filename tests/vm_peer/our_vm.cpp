#include "our_vm.hpp"

#include <algorithm>
#include <cstring>

namespace vagus::vm_peer {

const vm::Host OurVm::kHost = {send, send_variables, send_error, native, notify};

OurVm::OurVm(Loop loop)
    : loop_(loop),
      config_{Geometry::kId,
              Geometry::kBytecode,
              Geometry::kVariables,
              Geometry::kStack,
              Geometry::kArguments,
              bytecode_.memory(),
              variables_,
              stack_,
              breakpoints_,
              &kHost,
              this} {
    vm::init(vm_, config_);
}

void OurVm::receive(uint16_t type, const std::vector<uint16_t>& words) {
    vm::receive(vm_, type, words.data(), static_cast<uint16_t>(words.size()));
}

void OurVm::receive_event(uint16_t source, uint16_t type, const std::vector<uint16_t>& arguments) {
    vm::receive_event(vm_, source, type, arguments.data(), static_cast<uint16_t>(arguments.size()));
}

void OurVm::local_event(uint16_t index) {
    vm::local_event(vm_, index);
}

uint16_t OurVm::run(uint16_t limit) {
    return loop_ == Loop::Fast ? fastvm::run(vm_, bytecode_, limit) : vm::run(vm_, limit);
}

State OurVm::state() const {
    State state;
    state.pc = vm_.pc;
    state.flags = vm_.flags;
    state.stack.assign(stack_, stack_ + vm_.depth);
    state.variables.assign(std::begin(variables_), std::end(variables_));
    state.bytecode.assign(bytecode_.words().begin(), bytecode_.words().end());
    state.breakpoints.assign(breakpoints_, breakpoints_ + vm_.breakpoint_count);
    std::sort(state.breakpoints.begin(), state.breakpoints.end());
    return state;
}

void OurVm::send(vm::Vm& vm, uint16_t type, const uint16_t* words, uint16_t count) {
    of(vm).see();
    Sent sent{type, {}};
    for (uint16_t i = 0; i < count; ++i) append_word(sent.payload, words[i]);
    of(vm).sent_.push_back(sent);
}

void OurVm::send_variables(vm::Vm& vm, uint16_t start, uint16_t count) {
    of(vm).see();
    Sent sent{0x9005, {}};
    append_word(sent.payload, start);
    for (uint16_t i = 0; i < count; ++i) {
        append_word(sent.payload, static_cast<uint16_t>(of(vm).variables_[start + i]));
    }
    of(vm).sent_.push_back(sent);
}

void OurVm::send_error(vm::Vm& vm, const char* text) {
    of(vm).see();
    Sent sent{0x9009, {}};
    append_word(sent.payload, vm.pc);
    sent.payload.push_back(static_cast<uint8_t>(std::strlen(text)));
    sent.payload.insert(sent.payload.end(), text, text + std::strlen(text));
    of(vm).sent_.push_back(sent);
}

// The two natives of the comparison, written as vm.hpp says; their rules: section 4.2.
void OurVm::native(vm::Vm& vm, uint16_t id) {
    of(vm).see();
    if (id != kNativeCopy && id != kNativeDivide) return vm::raise_node_error(vm, kNoSuchNative);
    const uint16_t dest = vm::pop(vm);
    const uint16_t first = vm::pop(vm);
    const uint16_t second = id == kNativeDivide ? vm::pop(vm) : first;
    const uint16_t size = vm::pop(vm);
    int16_t* const to = vm::memory(vm, dest, size);
    const int16_t* const a = vm::memory(vm, first, size);
    const int16_t* const b = vm::memory(vm, second, size);
    if (to == nullptr || a == nullptr || b == nullptr) return;
    for (uint16_t i = 0; i < size; ++i) {
        if (id == kNativeDivide && b[i] == 0) return vm::raise_division_by_zero(vm);
        to[i] = id == kNativeDivide ? static_cast<int16_t>(int32_t{a[i]} / b[i]) : a[i];
    }
}

void OurVm::notify(vm::Vm& vm, vm::Notice notice) {
    of(vm).see();
    of(vm).bytecode_.notice(notice);
}

}  // namespace vagus::vm_peer
