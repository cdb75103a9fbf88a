#include <algorithm>

#include "fastvm/run.hpp"
#include "vm/test_machine.hpp"

namespace vagus::vm {

// Tests write the machine's words themselves: they are decoded for each run.
uint16_t TestMachine::run(uint16_t limit) {
    fastvm::Bytecode decoded(config.bytecode_size);
    decoded.load(bytecode);
    config.bytecode = decoded.memory();
    const uint16_t done = fastvm::run(vm, decoded, limit);
    std::ranges::copy(decoded.words(), bytecode.begin());
    config.bytecode = bytecode.data();
    return done;
}

}  // namespace vagus::vm
