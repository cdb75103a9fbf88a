// The BBC micro:bit, first edition: an nRF51822 with a Cortex-M0 at 16 MHz, 256 KB of flash and 16
// KB of RAM. Numbers of registers and pins: nRF51 Series Reference Manual, and the schematics of
// the board.
#include "firmware/board.hpp"
#include "firmware/cortex-m/registers.hpp"
#include "firmware/cortex-m/vectors.hpp"
#include "firmware/node/machine.hpp"
#include "firmware/node/shared.hpp"

namespace vagus {
namespace board {

namespace {

constexpr uint32_t kUart = 0x40002000;
constexpr uint32_t kStartReceiving = kUart + 0x000;
constexpr uint32_t kStartSending = kUart + 0x008;
constexpr uint32_t kReceivedEvent = kUart + 0x108;
constexpr uint32_t kSentEvent = kUart + 0x11c;
constexpr uint32_t kUartInterrupts = kUart + 0x304;
constexpr uint32_t kUartEnable = kUart + 0x500;
constexpr uint32_t kSendPin = kUart + 0x50c;
constexpr uint32_t kReceivePin = kUart + 0x514;
constexpr uint32_t kReceived = kUart + 0x518;
constexpr uint32_t kToSend = kUart + 0x51c;
constexpr uint32_t kBaudRate = kUart + 0x524;
constexpr uint32_t kBaud115200 = 0x01d7e000;
constexpr uint32_t kReceivedBit = 1 << 2;
constexpr uint32_t kSentBit = 1 << 7;
constexpr uint32_t kPinToComputer = 24;
constexpr uint32_t kPinFromComputer = 25;

constexpr uint32_t kTimer = 0x40008000;
constexpr uint32_t kTimerStart = kTimer + 0x000;
constexpr uint32_t kTimerElapsed = kTimer + 0x140;
constexpr uint32_t kTimerShortcuts = kTimer + 0x200;
constexpr uint32_t kTimerInterrupts = kTimer + 0x304;
constexpr uint32_t kTimerPrescaler = kTimer + 0x510;
constexpr uint32_t kTimerCompare = kTimer + 0x540;
constexpr uint32_t kCompareBit = 1 << 16;

constexpr uint32_t kPins = 0x50000000;
constexpr uint32_t kPinsOut = kPins + 0x504;
constexpr uint32_t kPinsIn = kPins + 0x510;
constexpr uint32_t kPinsAreOut = kPins + 0x514;
// The matrix of lamps: a pin for each of 9 columns (low lights) and 3 rows (high lights). The first
// row is used.
constexpr uint32_t kFirstColumn = 4;
constexpr uint32_t kColumns = 0x1ff << kFirstColumn;
constexpr uint32_t kFirstRow = 1 << 13;
constexpr uint32_t kButtonA = 17;
constexpr uint32_t kButtonB = 26;
constexpr uint32_t kPinModes = kPins + 0x700;
constexpr uint32_t kPulledUp = 3 << 2;

constexpr uint32_t kFlashControl = 0x4001e000;
constexpr uint32_t kFlashReady = kFlashControl + 0x400;
constexpr uint32_t kFlashMode = kFlashControl + 0x504;
constexpr uint32_t kFlashErasePage = kFlashControl + 0x508;
constexpr uint32_t kPageBytes = 1024;
constexpr uint32_t kPagesOfSlot = 4;
constexpr uint32_t kSlotBytes = kPagesOfSlot * kPageBytes;
constexpr uint32_t kSlotsAt = 0x40000 - 2 * kSlotBytes;  // the end of the flash
enum FlashMode : uint32_t { Read = 0, Write = 1, Erase = 2 };

constexpr uint32_t kIdOfMaker = kSlotsAt - 4;  // written there with the program, or left erased

constexpr uint32_t kUartInterrupt = 2;
constexpr uint32_t kTimerInterrupt = 8;

firmware::Shared<uint16_t> milliseconds;
volatile bool sending;  // a byte is on its way

constexpr uint16_t kBytecodeWords = 2000;
constexpr uint16_t kVariablesWords = 1000;
constexpr uint16_t kStackWords = 64;
static_assert(firmware::kSlotOverhead + 2 * kBytecodeWords <= kSlotBytes,
              "a slot holds the whole bytecode");
firmware::Memories<kBytecodeWords, kVariablesWords, kStackWords> memories;

void begin_uart() {
    register_at(kSendPin) = kPinToComputer;
    register_at(kReceivePin) = kPinFromComputer;
    register_at(kBaudRate) = kBaud115200;
    register_at(kUartEnable) = 4;
    register_at(kUartInterrupts) = kReceivedBit | kSentBit;
    register_at(kStartReceiving) = 1;
    register_at(kStartSending) = 1;
}

// 16 MHz / 2^4 is a tick each microsecond; the timer begins again at 1,000.
void begin_clock() {
    register_at(kTimerPrescaler) = 4;
    register_at(kTimerCompare) = 1000;
    register_at(kTimerShortcuts) = 1;
    register_at(kTimerInterrupts) = kCompareBit;
    register_at(kTimerStart) = 1;
}

uint32_t address_of(uint8_t slot, uint16_t at) {
    return kSlotsAt + slot * kSlotBytes + at;
}

void wait_for_flash() {
    while (register_at(kFlashReady) == 0) {
    }
}

}  // namespace

const vm::Config kMachine = firmware::machine_of(memories);
const char kName[] = "microbit";

void begin() {
    register_at(kPinsAreOut) = kColumns | kFirstRow;
    register_at(kPinModes + 4 * kButtonA) = kPulledUp;
    register_at(kPinModes + 4 * kButtonB) = kPulledUp;
    begin_uart();
    begin_clock();
    register_at(kInterruptSetEnable) = (1 << kUartInterrupt) | (1 << kTimerInterrupt);
}

uint16_t now_ms() {
    return milliseconds.load();
}

void start_sending() {
    register_at(kInterruptSetPending) = 1 << kUartInterrupt;
}

void show_leds(uint16_t leds) {
    const uint32_t dark = ~(static_cast<uint32_t>(leds) << kFirstColumn) & kColumns;
    register_at(kPinsOut) = kFirstRow | dark;
}

// A pressed button pulls its pin down.
uint16_t buttons() {
    const uint32_t up = register_at(kPinsIn);
    return static_cast<uint16_t>((~(up >> kButtonA) & 1) | ((~(up >> kButtonB) & 1) << 1));
}

uint16_t first_id() {
    return static_cast<uint16_t>(register_at(kIdOfMaker));
}

void erase_slot(uint8_t slot) {
    for (uint32_t page = 0; page < kPagesOfSlot; ++page) {
        register_at(kFlashMode) = FlashMode::Erase;
        register_at(kFlashErasePage) = address_of(slot, static_cast<uint16_t>(page * kPageBytes));
        wait_for_flash();
    }
    register_at(kFlashMode) = FlashMode::Read;
}

void write_slot(uint8_t slot, uint16_t at, uint32_t value) {
    register_at(kFlashMode) = FlashMode::Write;
    register_at(address_of(slot, at)) = value;
    wait_for_flash();
    register_at(kFlashMode) = FlashMode::Read;
}

uint32_t read_slot(uint8_t slot, uint16_t at) {
    return register_at(address_of(slot, at));
}

}  // namespace board
}  // namespace vagus

extern "C" {

static void on_uart() {
    using namespace vagus;
    using namespace vagus::board;
    while (register_at(kReceivedEvent) != 0) {
        register_at(kReceivedEvent) = 0;
        on_byte(static_cast<uint8_t>(register_at(kReceived)));
    }
    if (sending && register_at(kSentEvent) == 0) return;
    register_at(kSentEvent) = 0;
    uint8_t byte = 0;
    sending = next_byte(byte);
    if (sending) register_at(kToSend) = byte;
}

// Looks at the serial line, too: the emulator raises no interrupt for a byte that had to wait for
// its reader.
static void on_timer() {
    vagus::register_at(vagus::board::kTimerElapsed) = 0;
    vagus::board::milliseconds.in_interrupt(
        static_cast<uint16_t>(vagus::board::milliseconds.in_interrupt() + 1));
    on_uart();
}

// Stack pointer, start, NMI, HardFault, … ; interrupt n is entry 16 + n.
__attribute__((section(".vectors"), used))
const Handler kVectors[16 + 9] = {reinterpret_cast<Handler>(&stack_top),
                                  start,
                                  fault,
                                  fault,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  fault,
                                  nullptr,
                                  nullptr,
                                  fault,
                                  fault,
                                  fault,
                                  fault,
                                  on_uart,
                                  fault,
                                  fault,
                                  fault,
                                  fault,
                                  fault,
                                  on_timer};

}  // extern "C"
