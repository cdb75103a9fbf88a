#include "chip.hpp"

#include <algorithm>

extern "C" {
#include <simavr/avr_eeprom.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
}

namespace vagus::emulator {

namespace {

constexpr const char* kChip = "atmega1284p";
constexpr size_t kNumberAt = kEepromBytes - 2;  // kIdOfMaker of firmware/avr/atmega1284p.cpp
constexpr int kRamEnd = 0x40ff;

avr_eeprom_desc_t whole(Eeprom& eeprom) {
    return {eeprom.data(), 0, static_cast<uint32_t>(eeprom.size())};
}

}  // namespace

Eeprom eeprom_with_number(uint16_t number) {
    Eeprom eeprom;
    eeprom.fill(0xff);
    eeprom[kNumberAt] = static_cast<uint8_t>(number & 0xff);
    eeprom[kNumberAt + 1] = static_cast<uint8_t>(number >> 8);
    return eeprom;
}

Chip::Chip(const std::string& image, const Eeprom& eeprom) : deepest_(kRamEnd) {
    load(image);
    Eeprom copy = eeprom;
    avr_eeprom_desc_t all = whole(copy);
    avr_ioctl(avr_, AVR_IOCTL_EEPROM_SET, &all);
    join_serial_line();
}

void Chip::load(const std::string& image) {
    elf_firmware_t firmware{};
    if (elf_read_firmware(image.c_str(), &firmware) != 0) {
        throw ChipError(image + ": cannot be read as a program; ./dev firmware builds it");
    }
    firmware.frequency = kClock;
    avr_ = avr_make_mcu_by_name(kChip);
    if (avr_ == nullptr) throw ChipError(std::string("this simavr knows no ") + kChip);
    avr_init(avr_);
    avr_load_firmware(avr_, &firmware);
    avr_->sleep = [](avr_t*, avr_cycle_count_t) {};  // the caller keeps the pace
    avr_->log = LOG_ERROR;
}

void Chip::join_serial_line() {
    uint32_t flags = 0;
    avr_ioctl(avr_, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
    flags &= ~static_cast<uint32_t>(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POOL_SLEEP);
    avr_ioctl(avr_, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    input_ = avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
    avr_irq_register_notify(
        avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT),
        [](avr_irq_t*, uint32_t value, void* self) {
            static_cast<Chip*>(self)->on_sent(static_cast<uint8_t>(value));
        },
        this);
    avr_irq_register_notify(
        avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUT_XON),
        [](avr_irq_t*, uint32_t, void* self) { static_cast<Chip*>(self)->takes_bytes_ = true; },
        this);
    avr_irq_register_notify(
        avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUT_XOFF),
        [](avr_irq_t*, uint32_t, void* self) { static_cast<Chip*>(self)->takes_bytes_ = false; },
        this);
    avr_irq_register_notify(
        avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('B'), IOPORT_IRQ_PIN_ALL),
        [](avr_irq_t*, uint32_t value, void* self) {
            static_cast<Chip*>(self)->on_lamps(static_cast<uint8_t>(value));
        },
        this);
}

void Chip::receive(uint8_t byte) {
    avr_raise_irq(input_, byte);
}

void Chip::run_until(uint64_t cycle) {
    while (avr_->cycle < cycle) {
        const int state = avr_run(avr_);
        deepest_ = std::min(deepest_, stack_pointer());
        if (state == cpu_Done || state == cpu_Crashed) {
            throw ChipError("the program crashed, or slept with interrupts off");
        }
    }
}

uint64_t Chip::cycle() const {
    return avr_->cycle;
}

Eeprom Chip::eeprom() const {
    Eeprom copy;
    avr_eeprom_desc_t all = whole(copy);
    avr_ioctl(avr_, AVR_IOCTL_EEPROM_GET, &all);
    return copy;
}

int Chip::deepest_stack() const {
    return kRamEnd - deepest_;
}

// 0 until the program has set it.
int Chip::stack_pointer() const {
    const int pointer = avr_->data[R_SPL] | (avr_->data[R_SPH] << 8);
    return pointer == 0 ? kRamEnd : pointer;
}

}  // namespace vagus::emulator
