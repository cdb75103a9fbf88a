// What every Cortex-M has: the way from power to main(), interrupts on and off, sleep, restart.
#include "firmware/board.hpp"
#include "firmware/cortex-m/registers.hpp"
#include "firmware/cortex-m/vectors.hpp"

int main();

extern "C" {

extern uint32_t bss_begin, bss_end;  // of the linker script

// No constant is in RAM, no object has a constructor (tools/firmware_build checks both): zeros are
// all there is to prepare.
void start() {
    for (uint32_t* word = &bss_begin; word < &bss_end; ++word) *word = 0;
    main();
}

// A fault of the processor: only a bug leads here. Starting again keeps the node on the bus.
void fault() {
    vagus::board::restart();
}

}  // extern "C"

namespace vagus {
namespace board {

uint8_t hold() {
    uint32_t mask;
    asm volatile("mrs %0, primask\n\tcpsid i" : "=r"(mask) : : "memory");
    return static_cast<uint8_t>(mask);
}

void release(uint8_t before) {
    asm volatile("msr primask, %0" : : "r"(static_cast<uint32_t>(before)) : "memory");
}

void sleep() {
    asm volatile("wfi" : : : "memory");
}

// Neither board has motors.
void alive() {}

void restart() {
    register_at(kApplicationInterrupt) = kResetRequest;
    for (;;) {
    }
}

}  // namespace board
}  // namespace vagus
