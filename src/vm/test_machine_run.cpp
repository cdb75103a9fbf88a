#include "vm/test_machine.hpp"

namespace vagus::vm {

uint16_t TestMachine::run(uint16_t limit) {
    return vm::run(vm, limit);
}

}  // namespace vagus::vm
