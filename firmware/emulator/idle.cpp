// A node with nothing to do sleeps, and costs the computer that emulates it little: of the
// 16,000,000 cycles of a second simavr takes one in sixteen at most, by itself or for an event of
// the chip. One in 40 is what the loop of the firmware needs, once in each millisecond.
//
//     vagus-avr-idle IMAGE.elf
#include <cstdio>

#include "chip.hpp"

using namespace vagus::emulator;

namespace {

constexpr uint64_t kTurnsMax = kClock / 16;

uint64_t turns_of_a_second(Chip& chip) {
    const uint64_t before = chip.turns();
    chip.run_until(chip.cycle() + kClock);
    return chip.turns() - before;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "vagus-avr-idle: expected one word: IMAGE.elf\n");
        return 2;
    }
    try {
        Chip chip(argv[1], eeprom_with_number(1));
        turns_of_a_second(chip);  // it starts
        const uint64_t turns = turns_of_a_second(chip);
        std::printf("%llu turns in an idle second\n", static_cast<unsigned long long>(turns));
        return turns <= kTurnsMax ? 0 : 1;
    } catch (const ChipError& error) {
        std::fprintf(stderr, "vagus-avr-idle: %s\n", error.what());
        return 2;
    }
}
