#include "firmware/node/fake_board.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "firmware/board.hpp"
#include "firmware/node/machine.hpp"

namespace vagus::firmware {

namespace {

constexpr int kTurnsMax = 100'000;  // more, and it never settles
TestBoard* the_board = nullptr;

}  // namespace

// The byte that is being written when the power goes is neither the old nor the new one.
void TestSlots::write(uint8_t slot, uint16_t at, uint8_t value) {
    ++writes;
    if (writes_left && *writes_left == 0) return;
    if (writes_left && --*writes_left == 0) value = static_cast<uint8_t>(value ^ 0x5a);
    bytes[slot].at(at) = value;
}

TestBoard::TestBoard(TestSlots& its_slots) : slots(its_slots) {
    the_firmware = {};
    assert(the_board == nullptr);
    the_board = this;
}

TestBoard::~TestBoard() {
    the_board = nullptr;
}

void TestBoard::hear(const std::vector<uint8_t>& bytes) {
    for (const uint8_t byte : bytes) board::on_byte(byte);
    settle();
}

void TestBoard::hear(const wire::Frame& frame) {
    hear(bytes_of(frame));
}

void TestBoard::settle() {
    for (int turns = 0; turns < kTurnsMax; ++turns) {
        const bool has_more = turn(firmware);
        uint8_t byte = 0;
        bool sends = false;
        while (!stuck && board::next_byte(byte)) {
            sent.push_back(byte);
            sends = true;
        }
        if (!sends && !has_more) return;
    }
}

void TestBoard::wait_ms(uint32_t milliseconds) {
    for (uint32_t i = 0; i < milliseconds; ++i) {
        ++now_ms;
        settle();
    }
}

std::vector<wire::Frame> TestBoard::said() {
    std::vector<wire::Frame> frames;
    wire::FrameReader reader;
    for (const uint8_t byte : sent) {
        reader.feed(&byte, 1);
        if (reader.complete()) frames.push_back(reader.frame());
    }
    sent.clear();
    return frames;
}

wire::Frame command(wire::MessageType type, const std::vector<uint16_t>& words) {
    return event(wire::kHostId, static_cast<uint16_t>(type), words);
}

wire::Frame event(uint16_t source, uint16_t number, const std::vector<uint16_t>& arguments) {
    wire::Frame frame{};
    frame.source = source;
    frame.type = number;
    frame.size = static_cast<uint16_t>(2 * arguments.size());
    for (size_t i = 0; i < arguments.size(); ++i) {
        frame.payload[2 * i] = static_cast<uint8_t>(arguments[i] & 0xff);
        frame.payload[2 * i + 1] = static_cast<uint8_t>(arguments[i] >> 8);
    }
    return frame;
}

std::vector<uint8_t> bytes_of(const wire::Frame& frame) {
    std::vector<uint8_t> bytes(wire::kFrameMax);
    bytes.resize(wire::encode(frame, bytes.data()));
    return bytes;
}

}  // namespace vagus::firmware

// ---- The board as the firmware sees it ----

namespace vagus::board {

namespace {

firmware::TestBoard& here() {
    assert(firmware::the_board != nullptr);
    return *firmware::the_board;
}

firmware::Memories<firmware::kTestBytecode, firmware::kTestVariables, firmware::kTestStack>
    memories;

}  // namespace

const vm::Config kMachine = firmware::machine_of(memories);
const char kName[] = "test";

// Power comes on: RAM is empty.
void begin() {
    memories = {};
}
uint16_t now_ms() {
    return static_cast<uint16_t>(here().now_ms);
}
uint8_t hold() {
    return 0;
}
void release(uint8_t) {}
void sleep() {}
void start_sending() {}
void show_leds(uint16_t leds) {
    here().leds = leds;
}
void set_motors(int16_t left, int16_t right) {
    here().motors = {left, right};
}
void alive() {}
uint16_t buttons() {
    return here().buttons;
}
uint16_t first_id() {
    return here().first_id;
}
// The real one does not return; the test starts the board again.
void restart() {
    ++here().restarts;
    here().firmware.restarts = false;
}

void erase_slot(uint8_t slot) {
    write_slot(slot, 0, 0xffffffff);
}
void write_slot(uint8_t slot, uint16_t at, uint32_t value) {
    for (uint16_t i = 0; i < 4; ++i) {
        here().slots.write(slot, static_cast<uint16_t>(at + i),
                           static_cast<uint8_t>(value >> (8 * i)));
    }
}
uint32_t read_slot(uint8_t slot, uint16_t at) {
    uint32_t value = 0;
    for (uint16_t i = 4; i-- > 0;) value = (value << 8) | here().slots.bytes[slot].at(at + i);
    return value;
}

void on_byte(uint8_t byte) {
    firmware::receive_byte(here().firmware.receiver, byte);
}
bool next_byte(uint8_t& byte) {
    return firmware::take_byte(here().firmware.sender, byte);
}

}  // namespace vagus::board
