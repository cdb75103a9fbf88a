// How the standard natives take their arguments from the stack: all of them first, checks after
// (section 4.1).
#pragma once

#include <stdint.h>

#include "node/node.hpp"
#include "vm/vm.hpp"

namespace vagus {
namespace node {

// Pops `kCount` addresses; sizes are popped next, by the caller, which knows how many there are.
template <uint8_t kCount>
struct Addresses {
    explicit Addresses(vm::Vm& vm) {
        for (uint16_t& address : at) address = vm::pop(vm);
    }
    uint16_t at[kCount];
};

// `kCount` vectors of one length, as most functions of math.* have them.
template <uint8_t kCount>
struct Vectors {
    explicit Vectors(vm::Vm& vm) {
        const Addresses<kCount> addresses(vm);
        size = vm::pop(vm);
        for (uint8_t i = 0; i < kCount; ++i) words[i] = vm::memory(vm, addresses.at[i], size);
    }
    // False: a vector lies outside the variables. The fault has been raised, nothing may be
    // touched.
    bool valid() const {
        for (const int16_t* vector : words) {
            if (vector == nullptr) return false;
        }
        return true;
    }

    int16_t* words[kCount];
    uint16_t size;
};

}  // namespace node
}  // namespace vagus
