// The commands of hosts: program, inspect, run, stop (docs/spec/aseba-wire-and-vm.md, section 2.3).
#include "vm/internal.hpp"

namespace vagus {
namespace vm {

using wire::MessageType;

namespace {

constexpr uint16_t kFirstCommand = static_cast<uint16_t>(MessageType::SetBytecode);
constexpr uint16_t kCommandCount = 15;

// The fewest payload words with which each command makes sense, destination included.
VAGUS_FLASH_TABLE(uint8_t, kWordsMin, kCommandCount) = {2, 1, 1, 1, 1, 1, 1, 2,
                                                        2, 1, 3, 2, 1, 1, 1};

// Forgets what every `when` saw, instruction by instruction (the original starts too late: section
// 8, D2).
void clear_when_memories(const Config& config) {
    uint16_t* const end = config.bytecode + config.bytecode_size;
    uint16_t* at = config.bytecode + count_inside(config.bytecode_size, 0, config.bytecode[0]);
    while (at < end) {
        if (isa::opcode_of(*at) == isa::Opcode::Branch)
            *at &= static_cast<uint16_t>(~isa::kBranchWasTrue);
        const uint8_t words = words_of(*at);
        at += words ? words : 1;
    }
}

void reset(Vm& vm) {
    vm.flags = wire::kFlagStep;
    clear_when_memories(*vm.config);
    vm.config->host->notify(vm, Notice::Reset);
    if (!start_event(vm, isa::kInitEvent)) report_state(vm);
}

// A set: what is there already succeeds and takes no further slot (D17).
void set_breakpoint(Vm& vm, uint16_t pc) {
    const uint16_t slot = find_breakpoint(vm, pc);
    const bool success = slot < kBreakpointsMax && pc < vm.config->bytecode_size;
    if (success) {
        vm.config->breakpoints[slot] = pc;
        if (slot == vm.breakpoint_count) ++vm.breakpoint_count;
    }
    const uint16_t answer[] = {pc, success};
    report(vm, MessageType::BreakpointSetResult, answer, 2);
}

void clear_breakpoint(Vm& vm, uint16_t pc) {
    const uint16_t slot = find_breakpoint(vm, pc);
    if (slot == vm.breakpoint_count) return;
    vm.config->breakpoints[slot] = vm.config->breakpoints[--vm.breakpoint_count];
}

}  // namespace

// The commands that are more than an answer end in a notice; all others return.
void receive(Vm& vm, uint16_t type, const uint16_t* words, uint16_t count) {
    const uint16_t command = static_cast<uint16_t>(type - kFirstCommand);
    if (command >= kCommandCount || count < flash_read(&kWordsMin[command])) return;
    const Config& config = *vm.config;
    if (words[0] != vm.id) return;
    count = static_cast<uint16_t>(count - 2);
    Notice notice;
    switch (static_cast<MessageType>(type)) {
        case MessageType::SetBytecode:
            store(config.bytecode, config.bytecode_size, words[1], words + 2, count);
            return reset(vm);
        case MessageType::Reset:
            return reset(vm);
        case MessageType::Run:
            vm.flags &= static_cast<uint16_t>(~wire::kFlagStep);
            report_state(vm);
            notice = Notice::Run;
            break;
        case MessageType::Pause:
            vm.flags |= wire::kFlagStep;
            return report_state(vm);
        case MessageType::Step:
            if (!is_active(vm)) return;
            execute(vm);
            return report_state(vm);
        case MessageType::Stop:
            vm.flags = wire::kFlagStep;
            return report_state(vm);
        case MessageType::GetExecutionState:
            return report_state(vm);
        case MessageType::BreakpointSet:
            return set_breakpoint(vm, words[1]);
        case MessageType::BreakpointClear:
            return clear_breakpoint(vm, words[1]);
        case MessageType::BreakpointClearAll:
            vm.breakpoint_count = 0;
            return;
        case MessageType::GetVariables:
            return config.host->send_variables(
                vm, words[1], count_inside(config.variables_size, words[1], words[2]));
        case MessageType::SetVariables:
            return store_variables(vm, words[1], words + 2, count);
        case MessageType::WriteBytecode:
            notice = Notice::WriteBytecode;
            break;
        case MessageType::Reboot:
            notice = Notice::Reboot;
            break;
        case MessageType::SuspendToRam:
            notice = Notice::Sleep;
            break;
        default:
            return;
    }
    config.host->notify(vm, notice);
}

}  // namespace vm
}  // namespace vagus
