// What comes in on the serial line of a board: any bytes, with pauses. 0xfe and a number is a pause
// of so many milliseconds, 0xfd a restart; what is saved stays.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "firmware/board.hpp"
#include "firmware/node/fake_board.hpp"

namespace {

constexpr uint8_t kPause = 0xfe, kRestart = 0xfd;
constexpr uint16_t kNumber = 7;
// A script may run for ever: the board gets so many turns for a byte.
constexpr int kTurnsOfByte = 4;

using vagus::firmware::TestBoard;
using vagus::firmware::TestSlots;

std::unique_ptr<TestBoard> switched_on(TestSlots& slots) {
    auto board = std::make_unique<TestBoard>(slots);
    board->first_id = kNumber;
    board->start();
    return board;
}

// All that it says are whole frames of one node.
void hear(vagus::wire::FrameReader& reader, uint8_t byte) {
    reader.feed(&byte, 1);
    if (reader.dropped() > 0) std::abort();
    if (reader.complete() && reader.frame().source == vagus::wire::kHostId) std::abort();
}

void run(TestBoard& board, vagus::wire::FrameReader& reader) {
    for (int i = 0; i < kTurnsOfByte; ++i) {
        vagus::firmware::turn(board.firmware);
        uint8_t byte = 0;
        while (vagus::board::next_byte(byte)) hear(reader, byte);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    TestSlots slots;
    std::unique_ptr<TestBoard> board = switched_on(slots);
    vagus::wire::FrameReader reader;
    for (size_t i = 0; i < size; ++i) {
        if (bytes[i] == kRestart || board->restarts > 0) {
            board.reset();
            board = switched_on(slots);
        } else if (bytes[i] == kPause && i + 1 < size) {
            board->now_ms += bytes[++i];
        } else {
            vagus::board::on_byte(bytes[i]);
        }
        run(*board, reader);
    }
    return 0;
}
