// ARM's MPS2 board with the image AN385: a Cortex-M3 at 25 MHz with the peripherals of ARM's design
// kit. Numbers of registers: Application Note AN385 and the Cortex-M System Design Kit manual. The
// board has no flash: what is kept lies in a part of its RAM that a restart leaves alone, but no
// loss of power.
#include "firmware/board.hpp"
#include "firmware/cortex-m/registers.hpp"
#include "firmware/cortex-m/vectors.hpp"
#include "firmware/node/machine.hpp"
#include "firmware/node/shared.hpp"

namespace vagus {
namespace board {

namespace {

constexpr uint32_t kUart = 0x40004000;
constexpr uint32_t kUartData = kUart + 0x00;
constexpr uint32_t kUartState = kUart + 0x04;
constexpr uint32_t kUartControl = kUart + 0x08;
constexpr uint32_t kUartInterrupts = kUart + 0x0c;
constexpr uint32_t kUartDivider = kUart + 0x10;
constexpr uint32_t kSendFull = 1 << 0;
constexpr uint32_t kReceiveFull = 1 << 1;
constexpr uint32_t kSendBit = 1 << 0;
constexpr uint32_t kReceiveBit = 1 << 1;
constexpr uint32_t kBothDirectionsAndInterrupts = 0xf;

constexpr uint32_t kReceivedInterrupt = 1 << 0;
constexpr uint32_t kSentInterrupt = 1 << 1;

constexpr uint32_t kClock = 25000000;
constexpr uint32_t kBaud = 115200;

constexpr uint32_t kLeds = 0x40028000;
constexpr uint32_t kButtons = 0x40028008;

constexpr uint32_t kSlotsAt = 0x00300000;
constexpr uint32_t kSlotBytes = 0x4000;
constexpr uint32_t kIdOfMaker = 0x003ffffc;

firmware::Shared<uint16_t> milliseconds;

constexpr uint16_t kBytecodeWords = 4000;
constexpr uint16_t kVariablesWords = 2000;
constexpr uint16_t kStackWords = 64;
static_assert(firmware::kSlotOverhead + 2 * kBytecodeWords <= kSlotBytes,
              "a slot holds the whole bytecode");
firmware::Memories<kBytecodeWords, kVariablesWords, kStackWords> memories;

uint32_t address_of(uint8_t slot, uint16_t at) {
    return kSlotsAt + slot * kSlotBytes + at;
}

}  // namespace

const vm::Config kMachine = firmware::machine_of(memories);
const char kName[] = "mps2-an385";

void begin() {
    register_at(kUartDivider) = kClock / kBaud;
    register_at(kUartControl) = kBothDirectionsAndInterrupts;
    register_at(kSysTickReload) = kClock / 1000 - 1;
    register_at(kSysTickControl) = 7;  // on, with interrupt, from the processor's clock
    register_at(kInterruptSetEnable) = kReceivedInterrupt | kSentInterrupt;
}

uint16_t now_ms() {
    return milliseconds.load();
}

void start_sending() {
    register_at(kInterruptSetPending) = kSentInterrupt;
}

void show_leds(uint16_t leds) {
    register_at(kLeds) = leds;
}

uint16_t buttons() {
    return static_cast<uint16_t>(register_at(kButtons) & 3);
}

uint16_t first_id() {
    return static_cast<uint16_t>(register_at(kIdOfMaker));
}

// What a flash would read after it was erased.
void erase_slot(uint8_t slot) {
    write_slot(slot, 0, 0xffffffff);
}

void write_slot(uint8_t slot, uint16_t at, uint32_t value) {
    register_at(address_of(slot, at)) = value;
}

uint32_t read_slot(uint8_t slot, uint16_t at) {
    return register_at(address_of(slot, at));
}

}  // namespace board
}  // namespace vagus

extern "C" {

static void on_received() {
    using namespace vagus;
    using namespace vagus::board;
    register_at(kUartInterrupts) = kReceiveBit;
    while ((register_at(kUartState) & kReceiveFull) != 0) {
        on_byte(static_cast<uint8_t>(register_at(kUartData)));
    }
}

static void on_sent() {
    using namespace vagus;
    using namespace vagus::board;
    register_at(kUartInterrupts) = kSendBit;
    uint8_t byte = 0;
    if ((register_at(kUartState) & kSendFull) == 0 && next_byte(byte))
        register_at(kUartData) = byte;
}

static void on_tick() {
    vagus::board::milliseconds.in_interrupt(
        static_cast<uint16_t>(vagus::board::milliseconds.in_interrupt() + 1));
}

// Stack pointer, start, NMI, HardFault, … ; interrupt n is entry 16 + n.
__attribute__((section(".vectors"), used))
const Handler kVectors[16 + 2] = {reinterpret_cast<Handler>(&stack_top),
                                  start,
                                  fault,
                                  fault,
                                  fault,
                                  fault,
                                  fault,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  fault,
                                  fault,
                                  nullptr,
                                  fault,
                                  on_tick,
                                  on_received,
                                  on_sent};

}  // extern "C"
