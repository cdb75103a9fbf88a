// An MPS2 in QEMU, where each instruction takes 2^kShift ns and the clock counts 25 MHz. A program
// for a Cortex-M0 runs there, too.
#include "../selftest/cortex_m0.cpp"

namespace {

constexpr uint32_t kControl = 0xe000e010;
constexpr uint32_t kReload = 0xe000e014;
constexpr uint32_t kCurrent = 0xe000e018;
constexpr uint32_t kMost = 0x00ffffff;
// -icount shift=10: 1,024 ns of 40 ns each.
constexpr uint32_t kTicksOfTenInstructions = 256;

volatile uint32_t& place(uint32_t address) {
    return *reinterpret_cast<volatile uint32_t*>(address);
}

}  // namespace

void board_begin() {
    place(kReload) = kMost;
    place(kControl) = 5;
}
// Counts down, and begins again: differences of less than 650,000 instructions are right.
uint32_t board_now() {
    static uint32_t last = kMost, ticks = 0;
    const uint32_t now = place(kCurrent);
    ticks += (last - now) & kMost;
    last = now;
    return ticks * 10 / kTicksOfTenInstructions;
}
