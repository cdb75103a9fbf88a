// An ATmega1284P at 16 MHz: 128 KB of flash, 16 KB of RAM, 4 KB of EEPROM. Names of registers: its
// data sheet.
#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>

#include "firmware/board.hpp"
#include "firmware/node/machine.hpp"
#include "firmware/node/shared.hpp"
#include "isa/flash.hpp"

namespace vagus {
namespace board {

namespace {

// 16 MHz / 8 / (16 + 1) are 117,647 baud, 2.1 percent too fast: within what a receiver takes.
constexpr uint8_t kBaudDivider = 16;
// 16 MHz / 64 / 250 are 1,000 a second.
constexpr uint8_t kTicksOfMillisecond = 250;

constexpr uint16_t kEepromBytes = 4096;
constexpr uint16_t kIdOfMaker = kEepromBytes - 2;
constexpr uint16_t kSlotBytes = 2044;

firmware::Shared<uint16_t> milliseconds;

constexpr uint16_t kBytecodeWords = 1000;
constexpr uint16_t kVariablesWords = 1000;
constexpr uint16_t kStackWords = 64;
static_assert(firmware::kSlotOverhead + 2 * kBytecodeWords <= kSlotBytes,
              "a slot holds the whole bytecode");
static_assert(2 * kSlotBytes <= kIdOfMaker, "both slots fit before the number of the maker");
firmware::Memories<kBytecodeWords, kVariablesWords, kStackWords> memories;

// Motors: the power of each is a pin of timer 2, its direction a pin beside it, low ahead.
constexpr uint8_t kLeftPower = 1 << PD7, kRightPower = 1 << PD6;  // OC2A, OC2B
constexpr uint8_t kLeftBack = 1 << PD4, kRightBack = 1 << PD5;
constexpr int16_t kFullPower = 255;

// Phase-correct: with 0 the pin stays low.
uint8_t power_of(int16_t target) {
    const int16_t size = target < -kFullPower || target > kFullPower ? kFullPower : target;
    return static_cast<uint8_t>(size < 0 ? -size : size);
}

void begin_motors() {
    OCR2A = 0;
    OCR2B = 0;
    DDRD = kLeftPower | kRightPower | kLeftBack | kRightBack;
    TCCR2A = (1 << COM2A1) | (1 << COM2B1) | (1 << WGM20);
    TCCR2B = 1 << CS21;  // 16 MHz / 8 / 510: 3.9 kHz
}

uint8_t* place_of(uint8_t slot, uint16_t at) {
    return reinterpret_cast<uint8_t*>(slot * kSlotBytes + at);
}

}  // namespace

const vm::Config kMachine = firmware::machine_of(memories);
VAGUS_FLASH_TEXT(kName, "atmega1284p");

// After its reset the watchdog goes on, with 16 ms: it is set before all else.
void begin() {
    MCUSR = 0;
    wdt_enable(WDTO_1S);
    alive();  // simavr counts by the new time only from here on
    begin_motors();
    DDRB = 0xff;   // lamps
    PORTC = 0xff;  // buttons, pulled up
    UCSR0A = 1 << U2X0;
    UBRR0 = kBaudDivider;
    UCSR0C = (1 << UCSZ01) | (1 << UCSZ00);
    UCSR0B = (1 << RXCIE0) | (1 << RXEN0) | (1 << TXEN0);
    TCCR0A = 1 << WGM01;
    TCCR0B = (1 << CS01) | (1 << CS00);
    OCR0A = kTicksOfMillisecond - 1;
    TIMSK0 = 1 << OCIE0A;
    SMCR = 0;  // idle: the clock and the serial line go on
    sei();
}

uint16_t now_ms() {
    return milliseconds.load();
}

uint8_t hold() {
    const uint8_t before = SREG;
    cli();
    return before;
}

void release(uint8_t before) {
    SREG = before;
}

void sleep() {
    sleep_mode();
}

void start_sending() {
    const uint8_t before = hold();
    UCSR0B |= 1 << UDRIE0;
    release(before);
}

void show_leds(uint16_t leds) {
    PORTB = static_cast<uint8_t>(leds);
}

void set_motors(int16_t left, int16_t right) {
    const uint8_t back =
        static_cast<uint8_t>((left < 0 ? kLeftBack : 0) | (right < 0 ? kRightBack : 0));
    PORTD = back;
    OCR2A = power_of(left);
    OCR2B = power_of(right);
}

void alive() {
    wdt_reset();
}

// A pressed button pulls its pin down.
uint16_t buttons() {
    return static_cast<uint8_t>(~PINC) & 3;
}

uint16_t first_id() {
    return eeprom_read_word(reinterpret_cast<const uint16_t*>(kIdOfMaker));
}

// To where power-on leads: begin() sets up again all that it needs.
void restart() {
    cli();
    asm volatile("jmp 0");
    __builtin_unreachable();
}

void erase_slot(uint8_t slot) {
    write_slot(slot, 0, 0xffffffff);
}

void write_slot(uint8_t slot, uint16_t at, uint32_t value) {
    eeprom_update_dword(reinterpret_cast<uint32_t*>(place_of(slot, at)), value);
}

uint32_t read_slot(uint8_t slot, uint16_t at) {
    return eeprom_read_dword(reinterpret_cast<const uint32_t*>(place_of(slot, at)));
}

}  // namespace board
}  // namespace vagus

ISR(USART0_RX_vect) {
    vagus::board::on_byte(UDR0);
}

ISR(USART0_UDRE_vect) {
    uint8_t byte = 0;
    if (vagus::board::next_byte(byte)) {
        UDR0 = byte;
    } else {
        UCSR0B &= static_cast<uint8_t>(~(1 << UDRIE0));
    }
}

ISR(TIMER0_COMPA_vect) {
    uint16_t now = vagus::board::milliseconds.in_interrupt();
    vagus::board::milliseconds.in_interrupt(++now);
}
