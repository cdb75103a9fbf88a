// An ATmega1284P that runs an image, by simavr's library: its serial line, its lamps, its EEPROM,
// and time as its own cycles. Used by avr.cpp (a board in real time), latency.cpp (two boards on
// one clock), and tests that look inside: interrupted.cpp, motors.cpp.
//
//     Chip chip(load_image("atmega1284p.elf"));
//     chip.on_sent = [&](uint8_t byte) { line.push_back(byte); };
//     chip.receive(byte);
//     chip.run_until(chip.cycle() + kCyclesOfMillisecond);
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

extern "C" {
struct avr_t;
struct avr_irq_t;
}

namespace vagus::emulator {

constexpr uint32_t kClock = 16'000'000;
constexpr uint32_t kCyclesOfMillisecond = kClock / 1000;
constexpr uint32_t kBytesOfMillisecond = 11;  // of a line at 115,200 baud
constexpr size_t kEepromBytes = 4096;
constexpr uint16_t kRamBegin = 0x100;
constexpr uint16_t kRamBytes = 0x4000;

using Eeprom = std::array<uint8_t, kEepromBytes>;

// As the maker of a board delivers it: empty but for the board's number.
Eeprom eeprom_with_number(uint16_t number);

// Something is wrong with the image, or with the program in it: a sentence.
struct ChipError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Chip {
public:
    Chip(const std::string& image, const Eeprom& eeprom);
    Chip(const Chip&) = delete;
    Chip& operator=(const Chip&) = delete;

    std::function<void(uint8_t)> on_sent = [](uint8_t) {};
    std::function<void(uint8_t)> on_lamps = [](uint8_t) {};

    // A byte comes in. simavr holds a few of them back and takes them at the speed of the line;
    // what comes while it does not take any is lost.
    void receive(uint8_t byte);
    bool takes_bytes() const { return takes_bytes_; }
    void run_until(uint64_t cycle);
    uint64_t cycle() const;
    Eeprom eeprom() const;
    // Bytes, since the beginning.
    int deepest_stack() const;

    // ---- for tests ----
    // How often simavr was asked to go on, by an instruction or over a time of sleep.
    uint64_t turns() const { return turns_; }
    // One instruction.
    void step();
    // The address of the byte of RAM that the next instruction loads; 0 if it loads none.
    uint16_t next_load() const;
    // Two bytes of RAM, low byte first.
    uint16_t word(uint16_t at) const;
    // A byte comes in, and its interrupt happens before the next instruction, unless interrupts are
    // off: then it waits.
    void receive_now(uint8_t byte);
    // From here on the program goes round one instruction, but takes interrupts.
    void hang();
    // Of motor 0 or 1: the compare register of its PWM.
    uint8_t power(int motor) const;

private:
    void load(const std::string& image);
    void join_serial_line();
    int stack_pointer() const;
    uint16_t pointer(int low_register) const;

    avr_t* avr_ = nullptr;  // of simavr, which frees it with the process
    avr_irq_t* input_ = nullptr;
    bool takes_bytes_ = true;
    uint64_t turns_ = 0;
    int deepest_;
};

}  // namespace vagus::emulator
