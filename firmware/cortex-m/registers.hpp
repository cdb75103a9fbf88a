// A register of a Cortex-M or of what the maker of the chip put around it, by its address.
#pragma once

#include <stdint.h>

namespace vagus {

inline volatile uint32_t& register_at(uint32_t address) {
    return *reinterpret_cast<volatile uint32_t*>(address);
}

// Of every Cortex-M.
constexpr uint32_t kInterruptSetEnable = 0xe000e100;
constexpr uint32_t kInterruptSetPending = 0xe000e200;
constexpr uint32_t kSysTickControl = 0xe000e010;
constexpr uint32_t kSysTickReload = 0xe000e014;
constexpr uint32_t kApplicationInterrupt = 0xe000ed0c;
constexpr uint32_t kResetRequest = 0x05fa0004;

}  // namespace vagus
