// A Cortex-M0 under an emulator: prints and ends through semihosting (SYS_WRITEC, SYS_EXIT).
// Nothing runs before main but the loading of stack pointer and program counter: the program has no
// initialised variables besides those that the emulator puts into RAM (cortex_m0.ld).
#include <stdint.h>

int main();

namespace {

constexpr uint32_t kWriteChar = 0x03;
constexpr uint32_t kExit = 0x18;
constexpr uint32_t kApplicationExit = 0x20026;

void semihosting(uint32_t operation, uint32_t argument) {
    register uint32_t r0 asm("r0") = operation;
    register uint32_t r1 asm("r1") = argument;
    asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

}  // namespace

void board_print(char c) {
    semihosting(kWriteChar, reinterpret_cast<uint32_t>(&c));
}
void board_exit() {
    semihosting(kExit, kApplicationExit);
}

extern "C" {

extern char stack_top;

void start() {
    main();
    for (;;) {
    }
}

__attribute__((section(".vectors"), used)) void* const vectors[] = {
    &stack_top, reinterpret_cast<void*>(&start)};
}
