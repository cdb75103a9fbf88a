// Our machine with the same verbs as PeerVm, so that a test can drive both alike.
#pragma once

#include <cstdint>
#include <vector>

#include "machine.hpp"
#include "vm/vm.hpp"

namespace vagus::vm_peer {

class OurVm {
public:
    OurVm();
    OurVm(const OurVm&) = delete;
    OurVm& operator=(const OurVm&) = delete;

    void receive(uint16_t type, const std::vector<uint16_t>& words);
    void receive_event(uint16_t source, uint16_t type, const std::vector<uint16_t>& arguments);
    void local_event(uint16_t index);
    void run(uint16_t limit);

    State state() const;
    std::vector<Sent>& sent() { return sent_; }
    const std::vector<Sent>& sent() const { return sent_; }

private:
    static OurVm& of(vm::Vm& vm) { return *static_cast<OurVm*>(vm.config->owner); }
    static void send(vm::Vm& vm, uint16_t type, const uint16_t* words, uint16_t count);
    static void send_variables(vm::Vm& vm, uint16_t start, uint16_t count);
    static void send_error(vm::Vm& vm, const char* text);
    static void native(vm::Vm& vm, uint16_t id);
    static void notify(vm::Vm& vm, vm::Notice notice);
    static const vm::Host kHost;

    uint16_t bytecode_[Geometry::kBytecode] = {};
    int16_t variables_[Geometry::kVariables] = {};
    int16_t stack_[Geometry::kStack] = {};
    uint16_t breakpoints_[vm::kBreakpointsMax] = {};
    const vm::Config config_;
    vm::Vm vm_;
    std::vector<Sent> sent_;
};

}  // namespace vagus::vm_peer
