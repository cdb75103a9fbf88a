// The hooks of libasebavm are C functions with fixed names. They find our object by the address of
// the machine's state, which is its first member. An assertion jumps back to where the machine was
// called: the library is C, nothing is lost.
#include "peer_vm.hpp"

#include <algorithm>
#include <csetjmp>
#include <cstring>

#define ASEBA_ASSERT
#include "vm/natives.h"
#include "vm/vm.h"

namespace vagus::vm_peer {

struct PeerInsides {
    AsebaVMState vm{};
    uint16_t bytecode[Geometry::kBytecode] = {};
    int16_t variables[Geometry::kVariables] = {};
    int16_t stack[Geometry::kStack] = {};
    std::vector<Sent> sent;
    std::jmp_buf assertion;

    // Calls the machine; false if it came back through an assertion.
    template <typename Call>
    bool guarded(const Call& call) {
        if (setjmp(assertion) != 0) return false;
        call();
        return true;
    }
};

PeerVm::PeerVm() : insides_(new PeerInsides) {
    AsebaVMState& vm = insides_->vm;
    vm.nodeId = Geometry::kId;
    vm.bytecodeSize = Geometry::kBytecode;
    vm.bytecode = insides_->bytecode;
    vm.variablesSize = Geometry::kVariables;
    vm.variables = insides_->variables;
    vm.stackSize = Geometry::kStack;
    vm.stack = insides_->stack;
    AsebaVMInit(&vm);
    vm.sp = -1;
}

PeerVm::~PeerVm() {
    delete insides_;
}

bool PeerVm::receive(uint16_t type, const std::vector<uint16_t>& words) {
    std::vector<uint16_t> copy = words;
    return insides_->guarded([this, type, &copy] {
        AsebaVMDebugMessage(&insides_->vm, type, copy.data(), static_cast<uint16_t>(copy.size()));
    });
}

bool PeerVm::receive_event(uint16_t source, uint16_t type, const std::vector<uint16_t>& arguments) {
    AsebaVMState& vm = insides_->vm;
    if ((vm.flags & 3) == 3) return true;  // the glue's part: section 3.6
    vm.variables[1] = static_cast<int16_t>(source);
    const size_t count = std::min<size_t>(arguments.size(), Geometry::kArguments);
    for (size_t i = 0; i < count; ++i) vm.variables[2 + i] = static_cast<int16_t>(arguments[i]);
    return insides_->guarded([&vm, type] { AsebaVMSetupEvent(&vm, type); });
}

bool PeerVm::local_event(uint16_t index) {
    AsebaVMState& vm = insides_->vm;
    if ((vm.flags & 3) == 3) return true;
    return insides_->guarded(
        [&vm, index] { AsebaVMSetupEvent(&vm, static_cast<uint16_t>(0xfffe - index)); });
}

bool PeerVm::run(uint16_t limit) {
    return insides_->guarded([this, limit] { AsebaVMRun(&insides_->vm, limit); });
}

State PeerVm::state() const {
    const AsebaVMState& vm = insides_->vm;
    State state;
    state.pc = vm.pc;
    state.flags = vm.flags;
    state.stack.assign(vm.stack, vm.stack + vm.sp + 1);
    state.variables.assign(vm.variables, vm.variables + vm.variablesSize);
    state.bytecode.assign(vm.bytecode, vm.bytecode + vm.bytecodeSize);
    state.breakpoints.assign(vm.breakpoints, vm.breakpoints + vm.breakpointsCount);
    std::sort(state.breakpoints.begin(), state.breakpoints.end());
    return state;
}

void PeerVm::set_bytecode(const std::vector<uint16_t>& bytecode) {
    std::copy(bytecode.begin(), bytecode.end(), insides_->bytecode);
}

std::vector<Sent>& PeerVm::sent() {
    return insides_->sent;
}

namespace {

PeerInsides& insides_of(AsebaVMState* vm) {
    return *reinterpret_cast<PeerInsides*>(vm);
}

// The peer's natives check nothing: what they would read or write outside its memory counts as an
// assertion. The `addresses` lie above the size.
bool native_is_safe(const AsebaVMState& vm, int addresses) {
    if (vm.sp < addresses) return false;
    const uint16_t size = static_cast<uint16_t>(vm.stack[vm.sp - addresses]);
    for (int i = 0; i < addresses; ++i) {
        const unsigned address = static_cast<uint16_t>(vm.stack[vm.sp - i]);
        if (address + size > vm.variablesSize) return false;
    }
    return true;
}

}  // namespace

extern "C" {

void AsebaAssert(AsebaVMState* vm, AsebaAssertReason) {
    std::longjmp(insides_of(vm).assertion, 1);
}

void AsebaSendMessage(AsebaVMState* vm, uint16_t type, const void* data, uint16_t size) {
    const uint8_t* const bytes = static_cast<const uint8_t*>(data);
    insides_of(vm).sent.push_back({type, std::vector<uint8_t>(bytes, bytes + size)});
}

void AsebaSendVariables(AsebaVMState* vm, uint16_t start, uint16_t length) {
    Sent sent{0x9005, {}};
    append_word(sent.payload, start);
    for (uint16_t i = 0; i < length; ++i) {
        append_word(sent.payload, static_cast<uint16_t>(vm->variables[start + i]));
    }
    insides_of(vm).sent.push_back(sent);
}

void AsebaNativeFunction(AsebaVMState* vm, uint16_t id) {
    if (id == kNativeCopy) {
        if (!native_is_safe(*vm, 2)) AsebaAssert(vm, ASEBA_ASSERT_UNKNOWN);
        AsebaNative_veccopy(vm);
    } else if (id == kNativeDivide) {
        if (!native_is_safe(*vm, 3)) AsebaAssert(vm, ASEBA_ASSERT_UNKNOWN);
        AsebaNative_vecdiv(vm);
    } else {
        AsebaVMEmitNodeSpecificError(vm, kNoSuchNative);
    }
}

void AsebaSendDescription(AsebaVMState*) {}
void AsebaWriteBytecode(AsebaVMState*) {}
void AsebaResetIntoBootloader(AsebaVMState*) {}
void AsebaPutVmToSleep(AsebaVMState*) {}

}  // extern "C"

}  // namespace vagus::vm_peer
