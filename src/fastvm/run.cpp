#include "fastvm/run.hpp"

#include <algorithm>
#include <cassert>

namespace vagus::fastvm {

namespace {

// Cells call each other by jumps; where a compiler does not make jumps of them (without
// optimisation, with a sanitizer), so many calls lie on the stack of the processor.
constexpr int kStretchMax = 2048;

// Executes instructions as long as cells can; gives how many. 0: the next one is for vm::run().
int run_stretch(vm::Vm& vm, const Cells& cells, int limit) {
    const vm::Config& config = *vm.config;
    vm.flags |= wire::kFlagRunning;
    if (vm.pc >= cells.size()) return 0;
    Context context = {.vm = vm,
                       .cells = cells.data(),
                       .cell_count = cells.size(),
                       .bytecode = config.bytecode,
                       .stack = config.stack,
                       .stack_end = config.stack + config.stack_size};
    const int most = std::min(limit, kStretchMax);
    enter(cell_at(context, vm.pc), config.stack + vm.depth, config.variables, most, context);
    vm.pc = static_cast<uint16_t>(context.cell - cells.data());
    vm.depth = static_cast<uint16_t>(context.top - config.stack);
    if (context.over) vm.flags &= static_cast<uint16_t>(~(wire::kFlagActive | wire::kFlagRunning));
    return most - context.left;
}

// Goes on until the event is over, or `limit`. `done`: what has been executed of it.
[[gnu::noinline]] int run_on(vm::Vm& vm, const Cells& cells, int done, int limit) {
    // A pause is at a breakpoint, where the machine still counts as running.
    while (done < limit && vm::is_active(vm) && !vm::is_paused_in_event(vm)) {
        const int quick = run_stretch(vm, cells, limit - done);
        done += quick;
        if (quick == 0) done += vm::run(vm, 1);
    }
    if (!vm::is_paused_in_event(vm)) vm.flags &= static_cast<uint16_t>(~wire::kFlagRunning);
    return done;
}

}  // namespace

uint16_t run(vm::Vm& vm, Bytecode& bytecode, uint16_t limit) {
    assert(vm.config->bytecode == bytecode.memory());
    if (!vm::is_active(vm) || vm::is_paused_in_event(vm)) return vm::run(vm, limit);
    const Cells& cells =
        bytecode.cells(vm.config->variables_size, {vm.config->breakpoints, vm.breakpoint_count});
    // Most handlers end within one stretch.
    int done = run_stretch(vm, cells, limit);
    if ((vm.flags & wire::kFlagRunning) != 0) done = run_on(vm, cells, done, limit);
    return static_cast<uint16_t>(done);
}

}  // namespace vagus::fastvm
