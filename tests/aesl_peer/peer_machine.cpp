// Debian's machine behind peer.hpp. Its surroundings are C functions with fixed names; they find
// the run that is going on through one pointer.
#include <algorithm>
#include <cassert>
#include <cstring>

#include "peer.hpp"
#include "vm/natives.h"

namespace vagus::aesl {
namespace {

constexpr uint16_t kInitEvent = 0xffff;
constexpr uint16_t kLocalEventFirst = 0xfffe;
constexpr uint16_t kOutOfBounds = 0x9006;
constexpr uint16_t kDivisionByZero = 0x9007;
constexpr uint16_t kNodeSpecific = 0x9009;
constexpr uint16_t kFlagActive = 1;
constexpr uint16_t kRunSteps = 10'000;
constexpr int kRunsMax = 200;  // of kRunSteps; as many steps as our machine gets

constexpr AsebaNativeFunctionPointer kStandardNatives[] = {ASEBA_NATIVES_STD_FUNCTIONS};

class PeerMachine {
public:
    PeerMachine(const PeerProgram& program, const NodeFile& node, Outcome& outcome)
        : program_(program),
          node_(node),
          outcome_(outcome),
          bytecode_(node.target.bytecode_size),
          variables_(node.target.variables_size),
          stack_(node.target.stack_size) {
        vm_.bytecodeSize = node.target.bytecode_size;
        vm_.bytecode = bytecode_.data();
        vm_.variablesSize = node.target.variables_size;
        vm_.variables = variables_.data();
        vm_.stackSize = node.target.stack_size;
        vm_.stack = stack_.data();
        AsebaVMInit(&vm_);
        AsebaSetRandomSeed(0);
        std::copy(program.bytecode.begin(), program.bytecode.end(), bytecode_.begin());
    }

    void run(size_t during, uint16_t event) {
        during_ = during;
        if (AsebaVMSetupEvent(&vm_, event) == 0) return;
        for (int i = 0; i < kRunsMax && (vm_.flags & kFlagActive) != 0; ++i)
            AsebaVMRun(&vm_, kRunSteps);
        if ((vm_.flags & kFlagActive) != 0) outcome_.out_of_steps = true;
    }

    void set(size_t address, const Words& words) {
        std::copy(words.begin(), words.end(), variables_.begin() + static_cast<ptrdiff_t>(address));
    }

    bool has_stopped() const { return outcome_.fault || outcome_.out_of_steps; }

    void store_memory() {
        for (const auto& [name, place] : program_.variables) {
            const auto begin = variables_.begin() + static_cast<ptrdiff_t>(place.first);
            outcome_.memory[name] = Words(begin, begin + static_cast<ptrdiff_t>(place.second));
        }
    }

    // What the machine sends.
    void take(uint16_t type, const uint8_t* bytes, size_t size) {
        Words words(size / 2);
        if (!words.empty()) std::memcpy(words.data(), bytes, 2 * words.size());
        if (type < node_.common.events.size()) {
            outcome_.emitted.push_back({during_, node_.common.events[type].name, words});
        } else if (type == kOutOfBounds) {
            fault(FaultCause::ArrayOutOfBounds, words);
        } else if (type == kDivisionByZero) {
            fault(FaultCause::DivisionByZero, words);
        } else if (type == kNodeSpecific) {
            fault(FaultCause::NodeSpecific, words);
        } else {
            // Reports of state: nobody asked.
        }
    }

    void native(uint16_t id) {
        if (id < std::size(kStandardNatives)) return kStandardNatives[id](&vm_);
        const std::string& name = node_.target.natives[id].name;
        if (name == "sys.nop") return;
        assert(name == "sys.sum");
        const uint16_t dest = pop();
        const uint16_t src = pop();
        const uint16_t size = pop();
        int16_t sum = 0;
        for (uint16_t i = 0; i < size; ++i)
            sum = static_cast<int16_t>(sum + variables_[static_cast<size_t>(src) + i]);
        variables_[dest] = sum;
    }

private:
    uint16_t pop() { return static_cast<uint16_t>(stack_[static_cast<size_t>(vm_.sp--)]); }

    void fault(FaultCause kind, const Words& words) {
        const auto pc = static_cast<uint16_t>(words[0]);
        outcome_.fault = Fault{kind, during_, program_.lines[pc]};
    }

    const PeerProgram& program_;
    const NodeFile& node_;
    Outcome& outcome_;
    std::vector<uint16_t> bytecode_;
    Words variables_;
    Words stack_;
    AsebaVMState vm_{};
    size_t during_ = 0;
};

// The one that is running.
PeerMachine* current = nullptr;

std::optional<uint16_t> event_number(const NodeFile& node, const std::string& name) {
    const auto& local = node.target.local_events;
    for (size_t i = 0; i < local.size(); ++i)
        if (local[i].name == name) return static_cast<uint16_t>(kLocalEventFirst - i);
    for (size_t i = 0; i < node.common.events.size(); ++i)
        if (node.common.events[i].name == name) return static_cast<uint16_t>(i);
    return std::nullopt;
}

void apply(PeerMachine& machine, const Stimulus& stimulus, size_t during, const NodeFile& node,
           const PeerProgram& program) {
    for (const auto& [name, words] : stimulus.set)
        machine.set(program.variables.at(name).first, words);
    if (stimulus.event.empty()) return;
    if (stimulus.source) machine.set(1, {*stimulus.source});
    machine.set(2, stimulus.arguments);
    if (const auto number = event_number(node, stimulus.event)) machine.run(during, *number);
}

}  // namespace

Outcome run_peer(PeerCompiler& compiler, const Case& program, const NodeFile& node) {
    Outcome outcome;
    const PeerProgram compiled = compiler.compile(program.source);
    outcome.error = compiled.error;
    if (outcome.error) return outcome;
    PeerMachine machine(compiled, node, outcome);
    current = &machine;
    machine.run(0, kInitEvent);
    for (size_t i = 0; i < program.stimuli.size() && !machine.has_stopped(); ++i)
        apply(machine, program.stimuli[i], i + 1, node, compiled);
    machine.store_memory();
    current = nullptr;
    return outcome;
}

}  // namespace vagus::aesl

extern "C" {
void AsebaSendMessage(AsebaVMState*, uint16_t id, const void* bytes, uint16_t size) {
    vagus::aesl::current->take(id, static_cast<const uint8_t*>(bytes), size);
}
void AsebaNativeFunction(AsebaVMState*, uint16_t id) {
    vagus::aesl::current->native(id);
}
void AsebaSendVariables(AsebaVMState*, uint16_t, uint16_t) {}
void AsebaSendDescription(AsebaVMState*) {}
void AsebaWriteBytecode(AsebaVMState*) {}
void AsebaResetIntoBootloader(AsebaVMState*) {}
void AsebaPutVmToSleep(AsebaVMState*) {}
void AsebaAssert(AsebaVMState*, int) {
    assert(false);
}
}
