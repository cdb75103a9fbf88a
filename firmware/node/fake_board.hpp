// A board for tests, on a computer: its time, its line and its slots are in the hands of the test.
// One at a time: a board's functions have no object.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/node/firmware.hpp"
#include "wire/frame.hpp"

namespace vagus::firmware {

constexpr uint16_t kTestBytecode = 600;
constexpr uint16_t kTestVariables = 200;
constexpr uint16_t kTestStack = 32;
constexpr size_t kTestSlotBytes = kSlotOverhead + 2 * kTestBytecode;

// What outlives a restart, and how it dies.
struct TestSlots {
    std::array<std::array<uint8_t, kTestSlotBytes>, kSlots> bytes;
    std::optional<size_t> writes_left;  // of bytes, until the power goes; none: it stays
    size_t writes = 0;                  // that were asked for

    TestSlots() {
        for (auto& slot : bytes) slot.fill(0xff);
    }
    void write(uint8_t slot, uint16_t at, uint8_t value);
};

class TestBoard {
public:
    explicit TestBoard(TestSlots& slots);
    ~TestBoard();
    TestBoard(const TestBoard&) = delete;
    TestBoard& operator=(const TestBoard&) = delete;

    void start() { firmware::start(firmware); }
    // The bytes come in, then turns until nothing is left to do. What is sent leaves at once,
    // unless `stuck`.
    void hear(const std::vector<uint8_t>& bytes);
    void hear(const wire::Frame& frame);
    void settle();
    // Time passes, turn by turn.
    void wait_ms(uint32_t milliseconds);
    // What was sent, since the last call.
    std::vector<wire::Frame> said();

    TestSlots& slots;
    uint32_t now_ms = 0;
    uint16_t leds = 0;
    uint16_t buttons = 0;
    std::array<int16_t, kMotors> motors = {};
    uint16_t first_id = 0xffff;
    bool stuck = false;
    int restarts = 0;
    std::vector<uint8_t> sent;
    Firmware& firmware = the_firmware;
};

// A command to a node: its words, the first is the node.
wire::Frame command(wire::MessageType type, const std::vector<uint16_t>& words);
wire::Frame event(uint16_t source, uint16_t number, const std::vector<uint16_t>& arguments);
std::vector<uint8_t> bytes_of(const wire::Frame& frame);

}  // namespace vagus::firmware
