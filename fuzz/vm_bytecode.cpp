// Arbitrary bytecode: the input is the program image, word by word. Every event of its vector is
// started and run for a while, the second time around by single steps and after a Reset.
#include "vm_guarded.hpp"

namespace vagus::vm {

namespace {

constexpr GuardedSizes kSizes = {256, 96, 16, 32};
constexpr uint16_t kInstructionsPerEvent = 300;

void command(GuardedMachine& machine, wire::MessageType type) {
    const uint16_t words[] = {GuardedMachine::kId};
    receive(machine.vm, static_cast<uint16_t>(type), words, 1);
    machine.check();
}

void run_event(GuardedMachine& machine, uint16_t event) {
    command(machine, wire::MessageType::Run);
    start_event(machine.vm, event);
    must(run(machine.vm, kInstructionsPerEvent) <= kInstructionsPerEvent);
    machine.check();
}

void step_through_event(GuardedMachine& machine, uint16_t event) {
    command(machine, wire::MessageType::Pause);
    start_event(machine.vm, event);
    for (uint16_t i = 0; i < kInstructionsPerEvent && is_active(machine.vm); ++i) {
        command(machine, wire::MessageType::Step);
    }
}

}  // namespace

}  // namespace vagus::vm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace vagus::vm;
    GuardedMachine machine(kSizes);
    Input input(data, size);
    for (uint16_t i = 0; i < kSizes.bytecode && !input.empty(); ++i)
        machine.bytecode.data()[i] = input.word();
    // A program can change its own vector (by the memory of a branch): go by what it was.
    const std::vector<uint16_t> image(machine.bytecode.data(),
                                      machine.bytecode.data() + kSizes.bytecode);
    const uint16_t end = std::min(image[0], uint16_t{40});
    for (uint16_t i = 1; i < end; i = static_cast<uint16_t>(i + 2)) run_event(machine, image[i]);
    command(machine, vagus::wire::MessageType::Reset);
    for (uint16_t i = 1; i < end; i = static_cast<uint16_t>(i + 2))
        step_through_event(machine, image[i]);
    return 0;
}
