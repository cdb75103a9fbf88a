// The machine of a board: its memories, of the sizes that the board's RAM and slots allow. Once, in
// the board's file:
//
//     firmware::Memories<2000, 1000, 64> memories;
//     const vm::Config kMachine = firmware::machine_of(memories);
#pragma once

#include <stdint.h>

#include "firmware/node/face.hpp"
#include "firmware/node/firmware.hpp"

namespace vagus {
namespace firmware {

// Sizes in words. A slot of the board holds the whole bytecode and kSlotOverhead bytes.
template <uint16_t kBytecode, uint16_t kVariables, uint16_t kStack>
struct Memories {
    static_assert(kBytecode % 2 == 0, "the bytecode is saved in pairs of words");
    uint16_t bytecode[kBytecode];
    int16_t variables[kVariables];
    int16_t stack[kStack];
};

// The number of the node is known later: start().
template <uint16_t kBytecode, uint16_t kVariables, uint16_t kStack>
constexpr vm::Config machine_of(Memories<kBytecode, kVariables, kStack>& memories) {
    return {wire::kInvalidId,
            kBytecode,
            kVariables,
            kStack,
            kArguments,
            memories.bytecode,
            memories.variables,
            memories.stack,
            the_firmware.breakpoints,
            &node::kMachineHost,
            &the_firmware.node};
}

}  // namespace firmware
}  // namespace vagus
