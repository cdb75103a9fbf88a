// An ATmega1284P: its 16-bit timer counts cycles.
#include <avr/io.h>

#include "../selftest/avr.cpp"

void board_begin() {
    TCCR1B = 1 << CS10;
}
// The timer wraps; between two calls that belong together less than 65,536 cycles go by.
uint32_t board_now() {
    static uint16_t last = 0;
    static uint32_t cycles = 0;
    const uint16_t now = TCNT1;
    cycles += static_cast<uint16_t>(now - last);
    last = now;
    return cycles;
}
