// Our machine with the same verbs as PeerVm, so that a test can drive both alike.
#pragma once

#include <cstdint>
#include <vector>

#include "fastvm/run.hpp"
#include "machine.hpp"
#include "vm/vm.hpp"

namespace vagus::vm_peer {

// The one that firmware has, or the one for hosts.
enum class Loop { Small, Fast };

// How a function of the Host found the machine.
struct Seen {
    uint16_t pc = 0, flags = 0, depth = 0;

    bool operator==(const Seen&) const = default;
};

class OurVm {
public:
    explicit OurVm(Loop loop);
    OurVm(const OurVm&) = delete;
    OurVm& operator=(const OurVm&) = delete;

    void receive(uint16_t type, const std::vector<uint16_t>& words);
    void receive_event(uint16_t source, uint16_t type, const std::vector<uint16_t>& arguments);
    void local_event(uint16_t index);
    uint16_t run(uint16_t limit);

    State state() const;
    std::vector<Sent>& sent() { return sent_; }
    const std::vector<Sent>& sent() const { return sent_; }
    // In every call of a function of the Host since the machine was made.
    const std::vector<Seen>& seen() const { return seen_; }

private:
    static OurVm& of(vm::Vm& vm) { return *static_cast<OurVm*>(vm.config->owner); }
    static void send(vm::Vm& vm, uint16_t type, const uint16_t* words, uint16_t count);
    static void send_variables(vm::Vm& vm, uint16_t start, uint16_t count);
    static void send_error(vm::Vm& vm, const char* text);
    static void native(vm::Vm& vm, uint16_t id);
    static void notify(vm::Vm& vm, vm::Notice notice);
    static const vm::Host kHost;

    void see() { seen_.push_back({vm_.pc, vm_.flags, vm_.depth}); }

    const Loop loop_;
    fastvm::Bytecode bytecode_{Geometry::kBytecode};
    int16_t variables_[Geometry::kVariables] = {};
    int16_t stack_[Geometry::kStack] = {};
    uint16_t breakpoints_[vm::kBreakpointsMax] = {};
    const vm::Config config_;
    vm::Vm vm_;
    std::vector<Sent> sent_;
    std::vector<Seen> seen_;
};

}  // namespace vagus::vm_peer
