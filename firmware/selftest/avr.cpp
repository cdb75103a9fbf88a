// An ATmega328P: prints on its UART; sleeping with interrupts off ends simavr.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

void board_print(char c) {
    UCSR0B = 1 << TXEN0;
    while (!(UCSR0A & (1 << UDRE0))) {
    }
    UDR0 = static_cast<unsigned char>(c);
}

void board_exit() {
    while (!(UCSR0A & (1 << UDRE0))) {
    }
    cli();
    sleep_enable();
    sleep_cpu();
}
