// The two loops of the machine, one machine each, fed the same: commands, events and runs. After
// each act they must be equal to the last word, and must have called their Hosts alike. The input
// is that of vm_messages.cpp: four bytes for sizes, then acts; 0xff is a long run.
#include <array>
#include <string_view>

#include "fastvm/run.hpp"
#include "vm_guarded.hpp"

namespace vagus::fastvm {

namespace {

using vm::Guarded;
using vm::Input;
using vm::must;

constexpr uint16_t kId = 1;
constexpr uint8_t kAnyMessage = 0x20;
constexpr uint8_t kUserEvent = 0x21;
constexpr uint8_t kLocalEvent = 0x22;
constexpr uint8_t kLongRun = 0xff;
constexpr uint16_t kLongRunLimit = 5000;
constexpr uint16_t kFirstCommand = 0xa000;

enum class Loop { Small, Fast };

class Machine {
public:
    Machine(const vm::GuardedSizes& sizes, Loop loop)
        : loop_(loop),
          bytecode_(sizes.bytecode),
          variables_(sizes.variables),
          stack_(sizes.stack),
          breakpoints_(vm::kBreakpointsMax),
          config_{kId,
                  sizes.bytecode,
                  sizes.variables,
                  sizes.stack,
                  sizes.arguments,
                  bytecode_.memory(),
                  variables_.data(),
                  stack_.data(),
                  breakpoints_.data(),
                  &kHost,
                  this} {
        vm::init(vm_, config_);
    }
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    void receive(uint16_t type, const std::vector<uint16_t>& words) {
        vm::receive(vm_, type, words.data(), static_cast<uint16_t>(words.size()));
    }
    void event(uint16_t source, uint16_t type, const std::vector<uint16_t>& arguments) {
        vm::receive_event(vm_, source, type, arguments.data(),
                          static_cast<uint16_t>(arguments.size()));
    }
    void local_event(uint8_t index) { vm::local_event(vm_, index); }
    void run(uint16_t limit) {
        const uint16_t done =
            loop_ == Loop::Fast ? fastvm::run(vm_, bytecode_, limit) : vm::run(vm_, limit);
        must(done <= limit);
        note({done});
    }

    void check() {
        variables_.check();
        stack_.check();
        breakpoints_.check();
    }
    bool equals(Machine& other) {
        const std::array<uint16_t, 4> ours = {vm_.flags, vm_.pc, vm_.depth, vm_.breakpoint_count};
        const std::array<uint16_t, 4> others = {other.vm_.flags, other.vm_.pc, other.vm_.depth,
                                                other.vm_.breakpoint_count};
        return ours == others && told_ == other.told_ &&
               std::ranges::equal(bytecode_.words(), other.bytecode_.words()) &&
               std::equal(variables_.data(), variables_.data() + variables_.size(),
                          other.variables_.data()) &&
               std::equal(stack_.data(), stack_.data() + vm_.depth, other.stack_.data());
    }

private:
    static Machine& of(vm::Vm& vm) { return *static_cast<Machine*>(vm.config->owner); }

    // A sum of all that the Host was told, in its order.
    void note(std::initializer_list<uint16_t> words) {
        for (const uint16_t word : words) told_ = (told_ ^ word) * 0x100000001b3;
    }
    void note_state() { note({vm_.flags, vm_.pc, vm_.depth}); }

    static void send(vm::Vm& vm, uint16_t type, const uint16_t* words, uint16_t count) {
        of(vm).note_state();
        of(vm).note({type, count});
        for (uint16_t i = 0; i < count; ++i) of(vm).note({words[i]});
    }
    static void send_variables(vm::Vm& vm, uint16_t start, uint16_t count) {
        of(vm).note_state();
        of(vm).note({start, count});
    }
    static void send_error(vm::Vm& vm, const char* text) {
        of(vm).note_state();
        for (const char letter : std::string_view(text))
            of(vm).note({static_cast<uint8_t>(letter)});
    }
    // The id says how many addresses it takes and whether it fails.
    static void native(vm::Vm& vm, uint16_t id) {
        of(vm).note_state();
        of(vm).note({id});
        uint16_t addresses[4];
        const unsigned count = id & 3;
        for (unsigned i = 0; i <= count; ++i) addresses[i] = vm::pop(vm);
        const uint16_t size = vm::pop(vm);
        for (unsigned i = 0; i <= count; ++i) {
            int16_t* const place = vm::memory(vm, addresses[i], size);
            if (place == nullptr) return;
            for (uint16_t k = 0; k < size; ++k) place[k] = static_cast<int16_t>(place[k] ^ id);
        }
        if (id & 4) vm::raise_division_by_zero(vm);
        if (id & 8) vm::raise_out_of_bounds(vm, size, id);
    }
    static void notify(vm::Vm& vm, vm::Notice notice) {
        of(vm).note_state();
        of(vm).bytecode_.notice(notice);
    }
    static constexpr vm::Host kHost = {send, send_variables, send_error, native, notify};

    const Loop loop_;
    Bytecode bytecode_;
    Guarded<int16_t> variables_;
    Guarded<int16_t> stack_;
    Guarded<uint16_t> breakpoints_;
    const vm::Config config_;
    vm::Vm vm_ = {};
    uint64_t told_ = 0;
};

std::vector<uint16_t> words(Input& input, std::vector<uint16_t> first) {
    for (unsigned left = input.byte(); left > 0 && !input.empty(); --left)
        first.push_back(input.word());
    return first;
}

void act(std::array<Machine*, 2> machines, Input& input) {
    const uint8_t kind = input.byte();
    if (kind < kAnyMessage) {
        const auto type = static_cast<uint16_t>(kFirstCommand + kind);
        const std::vector<uint16_t> payload = words(input, {kId});
        for (Machine* machine : machines) machine->receive(type, payload);
    } else if (kind == kAnyMessage) {
        const uint16_t type = input.word();
        const std::vector<uint16_t> payload = words(input, {});
        for (Machine* machine : machines) machine->receive(type, payload);
    } else if (kind == kUserEvent) {
        const uint16_t source = input.word();
        const uint16_t type = input.word();
        const std::vector<uint16_t> arguments = words(input, {});
        for (Machine* machine : machines) machine->event(source, type, arguments);
    } else if (kind == kLocalEvent) {
        const uint8_t index = input.byte();
        for (Machine* machine : machines) machine->local_event(index);
    } else {
        const uint16_t limit = kind == kLongRun ? kLongRunLimit : kind;
        for (Machine* machine : machines) machine->run(limit);
    }
}

}  // namespace

}  // namespace vagus::fastvm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace vagus::fastvm;
    Input input(data, size);
    vagus::vm::GuardedSizes sizes{};
    sizes.bytecode = static_cast<uint16_t>(1 + input.byte());
    sizes.variables = static_cast<uint16_t>(2 * input.byte());
    sizes.stack = input.byte();
    sizes.arguments = input.byte();
    Machine small(sizes, Loop::Small);
    Machine fast(sizes, Loop::Fast);
    while (!input.empty()) {
        act({&small, &fast}, input);
        small.check();
        fast.check();
        must(fast.equals(small));
    }
    return 0;
}
