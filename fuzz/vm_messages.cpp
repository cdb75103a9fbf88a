// Arbitrary commands, events and runs on a node with small memories. The input: four bytes for the
// sizes of bytecode, variables, stack and arguments; then acts. An act is a byte that says which,
// and what it needs:
//
//     0x00 … 0x1f   command 0xa000 + so much to this node; byte: count; words after the destination
//     0x20          any message: word type; byte: word count; words
//     0x21          user event: word source, word type; byte: count; words
//     0x22          local event: byte
//     else          run at most so many instructions
#include "vm_guarded.hpp"

namespace vagus::vm {

namespace {

constexpr uint8_t kAnyMessage = 0x20;
constexpr uint8_t kUserEvent = 0x21;
constexpr uint8_t kLocalEvent = 0x22;
constexpr uint16_t kFirstCommand = 0xa000;

std::vector<uint16_t> words(Input& input, std::vector<uint16_t> first) {
    for (unsigned left = input.byte(); left > 0 && !input.empty(); --left)
        first.push_back(input.word());
    return first;
}

void message(GuardedMachine& machine, uint16_t type, const std::vector<uint16_t>& payload) {
    // On the heap and of the exact size, so that reading past its end is seen.
    receive(machine.vm, type, payload.data(), static_cast<uint16_t>(payload.size()));
}

void act(GuardedMachine& machine, Input& input) {
    const uint8_t kind = input.byte();
    if (kind < kAnyMessage) {
        message(machine, kFirstCommand + kind, words(input, {GuardedMachine::kId}));
    } else if (kind == kAnyMessage) {
        const uint16_t type = input.word();
        message(machine, type, words(input, {}));
    } else if (kind == kUserEvent) {
        const uint16_t source = input.word();
        const uint16_t type = input.word();
        const std::vector<uint16_t> arguments = words(input, {});
        receive_event(machine.vm, source, type, arguments.data(),
                      static_cast<uint16_t>(arguments.size()));
    } else if (kind == kLocalEvent) {
        local_event(machine.vm, input.byte());
    } else {
        must(run(machine.vm, kind) <= kind);
    }
}

}  // namespace

}  // namespace vagus::vm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace vagus::vm;
    Input input(data, size);
    GuardedSizes sizes{};
    sizes.bytecode = static_cast<uint16_t>(1 + input.byte());
    sizes.variables = static_cast<uint16_t>(2 * input.byte());
    sizes.stack = input.byte();
    sizes.arguments = input.byte();
    GuardedMachine machine(sizes);
    while (!input.empty()) {
        act(machine, input);
        machine.check();
    }
    return 0;
}
