#include "chip.hpp"

#include <algorithm>
#include <cstring>

extern "C" {
#include <simavr/avr_eeprom.h>
#include <simavr/avr_extint.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_timer.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_interrupts.h>
}

namespace vagus::emulator {

namespace {

constexpr const char* kChip = "atmega1284p";
constexpr size_t kNumberAt = kEepromBytes - 2;  // kIdOfMaker of firmware/avr/atmega1284p.cpp
constexpr int kRamEnd = 0x40ff;
constexpr int kReceiveVector = 20;                    // USART0_RX_vect
constexpr uint16_t kPowerRegisters[] = {0xb3, 0xb4};  // OCR2A, OCR2B
constexpr uint32_t kLastWord = 0x1fffe;               // of the flash
constexpr uint16_t kJumpToItself = 0xcfff;

avr_eeprom_desc_t whole(Eeprom& eeprom) {
    return {eeprom.data(), 0, static_cast<uint32_t>(eeprom.size())};
}

// simavr does not know the phase-correct mode of the timers of eight bits, and counts to 0 in it:
// an event at each tick of timer 2, which drives the motors.
void teach_phase_correct_pwm(avr_t* avr) {
    for (avr_io_t* io = avr->io_port; io != nullptr; io = io->next) {
        if (std::strcmp(io->kind, "timer") != 0) continue;
        auto* const timer = reinterpret_cast<avr_timer_t*>(io);
        avr_timer_wgm_t& mode = timer->wgm_op[1];
        if (mode.kind == avr_timer_wgm_none) {
            mode = {.top = 0, .bottom = 0, .size = 8, .kind = avr_timer_wgm_fc_pwm};
        }
    }
}

// simavr asks in each cycle whether a pin that could interrupt is low still: a lamp that is off is
// such a pin, and no board here has interrupts of pins.
void ignore_low_pins(avr_t* avr) {
    constexpr uint8_t kPinsThatInterrupt = 3;
    for (uint8_t pin = 0; pin < kPinsThatInterrupt; ++pin) {
        avr_extint_set_strict_lvl_trig(avr, pin, 0);
    }
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
    // Without these an idle chip costs as much as a busy one.
    teach_phase_correct_pwm(avr_);
    ignore_low_pins(avr_);
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
        ++turns_;
        deepest_ = std::min(deepest_, stack_pointer());
        if (state == cpu_Done || state == cpu_Crashed) {
            throw ChipError("the program crashed, or slept with interrupts off");
        }
    }
}

void Chip::step() {
    avr_->run_cycle_limit = 1;
    avr_->run_cycle_count = 1;
    run_until(avr_->cycle + 1);
    avr_->run_cycle_limit = kCyclesOfMillisecond;
}

uint16_t Chip::pointer(int low_register) const {
    return static_cast<uint16_t>(avr_->data[low_register] | (avr_->data[low_register + 1] << 8));
}

// LDS, LD and LDD (AVR Instruction Set Manual).
uint16_t Chip::next_load() const {
    const uint8_t* const at = avr_->flash + avr_->pc;
    const auto opcode = static_cast<uint16_t>(at[0] | (at[1] << 8));
    const int offset = (opcode & 7) | ((opcode >> 7) & 0x18) | ((opcode >> 8) & 0x20);
    if ((opcode & 0xd208) == 0x8000) return static_cast<uint16_t>(pointer(R_ZL) + offset);
    if ((opcode & 0xd208) == 0x8008) return static_cast<uint16_t>(pointer(R_YL) + offset);
    switch (opcode & 0xfe0f) {
        case 0x9000:
            return static_cast<uint16_t>(at[2] | (at[3] << 8));
        case 0x9001:
            return pointer(R_ZL);
        case 0x9002:
            return static_cast<uint16_t>(pointer(R_ZL) - 1);
        case 0x9009:
            return pointer(R_YL);
        case 0x900a:
            return static_cast<uint16_t>(pointer(R_YL) - 1);
        case 0x900c:
        case 0x900d:
            return pointer(R_XL);
        case 0x900e:
            return static_cast<uint16_t>(pointer(R_XL) - 1);
        default:
            return 0;
    }
}

uint16_t Chip::word(uint16_t at) const {
    return static_cast<uint16_t>(avr_->data[at] | (avr_->data[at + 1] << 8));
}

void Chip::receive_now(uint8_t byte) {
    receive(byte);
    for (int i = 0; i < avr_->interrupts.vector_count; ++i) {
        avr_int_vector_t* const vector = avr_->interrupts.vector[i];
        if (vector->vector == kReceiveVector) avr_raise_interrupt(avr_, vector);
    }
    avr_service_interrupts(avr_);
}

void Chip::hang() {
    while (avr_->sreg[S_I] == 0) step();
    avr_->flash[kLastWord] = kJumpToItself & 0xff;
    avr_->flash[kLastWord + 1] = kJumpToItself >> 8;
    avr_->pc = kLastWord;
    avr_->state = cpu_Running;
}

uint8_t Chip::power(int motor) const {
    return avr_->data[kPowerRegisters[motor]];
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
