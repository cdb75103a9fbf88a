#include "fastvm/run.hpp"
#include "node/natives.hpp"
#include "node/node.hpp"
#include "vm_machines.hpp"

namespace vagus::bench {

namespace {

enum class Loop { Small, Fast };

class OurMachine final : public BenchMachine {
public:
    OurMachine(const MachineProgram& program, Loop loop)
        : loop_(loop),
          parameter_counts_(program.parameter_counts),
          bytecode_(program.bytecode_size),
          variables_(program.variables_size),
          stack_(program.stack_size),
          config_{.id = 1,
                  .bytecode_size = program.bytecode_size,
                  .variables_size = program.variables_size,
                  .stack_size = program.stack_size,
                  .arguments_capacity = 32,
                  .bytecode = bytecode_.memory(),
                  .variables = variables_.data(),
                  .stack = stack_.data(),
                  .breakpoints = breakpoints_,
                  .host = &kHost,
                  .owner = this} {
        vm::init(node_.vm, config_);
        bytecode_.load(program.bytecode);
    }

    void event(uint16_t event) override {
        vm::start_event(node_.vm, event);
        while (vm::is_active(node_.vm)) {
            instructions_ += loop_ == Loop::Fast
                                 ? fastvm::run(node_.vm, bytecode_, kInstructionsAtOnce)
                                 : vm::run(node_.vm, kInstructionsAtOnce);
        }
    }
    std::span<int16_t> variables() override { return variables_; }
    uint64_t sent() const override { return sent_; }
    uint64_t instructions() const override { return instructions_; }

private:
    static OurMachine& of(vm::Vm& vm) { return *static_cast<OurMachine*>(vm.config->owner); }
    static void send(vm::Vm& vm, uint16_t, const uint16_t*, uint16_t) { ++of(vm).sent_; }
    static void native(vm::Vm& vm, uint16_t id) {
        OurMachine& self = of(vm);
        if (id < node::kStandardNativeCount) return node::kStandardNatives[id].function(self.node_);
        for (uint16_t i = self.parameter_counts_[id]; i > 0; --i) (void)vm::pop(vm);
    }
    static constexpr vm::Host kHost = {send, [](vm::Vm&, uint16_t, uint16_t) {},
                                       [](vm::Vm&, const char*) {}, native,
                                       [](vm::Vm&, vm::Notice) {}};

    const Loop loop_;
    const std::vector<uint16_t> parameter_counts_;
    fastvm::Bytecode bytecode_;
    std::vector<int16_t> variables_;
    std::vector<int16_t> stack_;
    uint16_t breakpoints_[vm::kBreakpointsMax] = {};
    const vm::Config config_;
    node::Node node_ = {};
    uint64_t sent_ = 0;
    uint64_t instructions_ = 0;
};

}  // namespace

std::unique_ptr<BenchMachine> make_fast(const MachineProgram& program) {
    return std::make_unique<OurMachine>(program, Loop::Fast);
}

std::unique_ptr<BenchMachine> make_small(const MachineProgram& program) {
    return std::make_unique<OurMachine>(program, Loop::Small);
}

}  // namespace vagus::bench
