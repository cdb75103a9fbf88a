// Debian's libasebavm (public headers of the package aseba), for bench_vm.
#include <algorithm>

#define ASEBA_ASSERT  // as the library of the package has been compiled
#include "vm/natives.h"
#include "vm/vm.h"
#include "vm_machines.hpp"

namespace vagus::bench {

namespace {

constexpr uint16_t kFlagActive = 1;
constexpr uint16_t kUserEventLimit = 0x8000;
constexpr AsebaNativeFunctionPointer kStandardNatives[] = {ASEBA_NATIVES_STD_FUNCTIONS};

class PeerMachine final : public BenchMachine {
public:
    explicit PeerMachine(const MachineProgram& program)
        : parameter_counts_(program.parameter_counts),
          bytecode_(program.bytecode_size),
          variables_(program.variables_size),
          stack_(program.stack_size) {
        vm_.nodeId = 1;
        vm_.bytecodeSize = program.bytecode_size;
        vm_.bytecode = bytecode_.data();
        vm_.variablesSize = program.variables_size;
        vm_.variables = variables_.data();
        vm_.stackSize = program.stack_size;
        vm_.stack = stack_.data();
        AsebaVMInit(&vm_);
        AsebaSetRandomSeed(0);
        std::ranges::copy(program.bytecode, bytecode_.begin());
        running_ = this;
    }
    ~PeerMachine() override { running_ = nullptr; }
    PeerMachine(const PeerMachine&) = delete;
    PeerMachine& operator=(const PeerMachine&) = delete;

    void event(uint16_t event) override {
        AsebaVMSetupEvent(&vm_, event);
        while ((vm_.flags & kFlagActive) != 0) AsebaVMRun(&vm_, kInstructionsAtOnce);
    }
    std::span<int16_t> variables() override { return variables_; }
    uint64_t sent() const override { return sent_; }
    uint64_t instructions() const override { return 0; }

    void count_sent(uint16_t type) {
        if (type < kUserEventLimit) ++sent_;
    }
    void native(uint16_t id) {
        if (id < ASEBA_NATIVES_STD_COUNT) return kStandardNatives[id](&vm_);
        for (uint16_t i = parameter_counts_[id]; i > 0; --i) (void)AsebaNativePopArg(&vm_);
    }
    static PeerMachine* running_;

private:
    const std::vector<uint16_t> parameter_counts_;
    std::vector<uint16_t> bytecode_;
    std::vector<int16_t> variables_;
    std::vector<int16_t> stack_;
    AsebaVMState vm_ = {};
    uint64_t sent_ = 0;
};

PeerMachine* PeerMachine::running_ = nullptr;

}  // namespace

std::unique_ptr<BenchMachine> make_peer(const MachineProgram& program) {
    return std::make_unique<PeerMachine>(program);
}

extern "C" {

void AsebaSendMessage(AsebaVMState*, uint16_t type, const void*, uint16_t) {
    PeerMachine::running_->count_sent(type);
}
void AsebaNativeFunction(AsebaVMState*, uint16_t id) {
    PeerMachine::running_->native(id);
}
void AsebaSendVariables(AsebaVMState*, uint16_t, uint16_t) {}
void AsebaSendDescription(AsebaVMState*) {}
void AsebaWriteBytecode(AsebaVMState*) {}
void AsebaResetIntoBootloader(AsebaVMState*) {}
void AsebaPutVmToSleep(AsebaVMState*) {}
void AsebaAssert(AsebaVMState*, AsebaAssertReason) {}

}  // extern "C"

}  // namespace vagus::bench
