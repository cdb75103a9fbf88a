// From an event to the answer of another node: two emulated ATmega1284P on one clock, joined by the
// hub of src/hub, each by a line of 115,200 baud. Node 1 emits event 0 every 50 ms and turns lamp 0
// on; node 2 answers by event 1; when it comes, node 1 turns lamp 1 on. All times are cycles of the
// chips: every run gives the same.
//
//     vagus-avr-latency IMAGE.elf
#include <cstdio>
#include <deque>
#include <memory>
#include <vector>

#include "chip.hpp"
#include "hub/hub.hpp"
#include "wire/frame.hpp"
#include "wire/protocol.hpp"

namespace {

using namespace vagus;
using namespace vagus::emulator;
using Words = std::vector<uint16_t>;

constexpr uint32_t kCyclesOfByte = kClock / (115'200 / 10);
constexpr uint32_t kSlice = 100;  // cycles that one chip runs ahead of the other, at most
constexpr uint64_t kSeconds = 2;
constexpr uint16_t kPeriodAt = 38;
constexpr size_t kRoundsMin = 30;
// 8 bytes four times, at the chips' 117,647 baud or the line's 115,200: 2.7 ms; the rest is the
// nodes'.
constexpr double kLine_ms = 2.72;
constexpr double kNodes_ms = 2.0;

// onevent timer: leds = 1, emit 0 [variable 60]. onevent 1: leds = 2.
const Words kAsks = {5, 0xfffe, 5, 1, 11, 0x1001, 0x4024, 0xb000, 60, 1, 0, 0x1002, 0x4024, 0};
// onevent 0: emit 1 [event.args[0]]
const Words kAnswers = {3, 0, 3, 0xb001, 2, 1, 0};

class Node {
public:
    Node(const std::string& image, uint16_t number, hub::Hub& hub)
        : chip_(image, eeprom_with_number(number)),
          hub_(hub),
          link_(hub.add({.name = "node"}).value()) {
        chip_.on_sent = [this](uint8_t byte) { send(byte); };
    }

    Chip& chip() { return chip_; }
    size_t bytes() const { return bytes_; }

    void run_until(uint64_t cycle) {
        if (const auto output = hub_.output(link_); !output.empty()) {
            line_.insert(line_.end(), output.begin(), output.end());
            hub_.sent(link_, output.size());
        }
        if (!line_.empty() && cycle >= next_byte_) {
            chip_.receive(line_.front());
            line_.pop_front();
            next_byte_ = cycle + kCyclesOfByte;
        }
        chip_.run_until(cycle);
    }

private:
    void send(uint8_t byte) {
        ++bytes_;
        reader_.feed(&byte, 1);
        if (reader_.complete()) hub_.receive(link_, reader_.frame());
    }

    Chip chip_;
    hub::Hub& hub_;
    hub::LinkId link_;
    wire::FrameReader reader_;
    std::deque<uint8_t> line_;
    uint64_t next_byte_ = 0;
    size_t bytes_ = 0;
};

wire::Frame command(wire::MessageType type, const Words& words) {
    wire::Frame frame{};
    frame.type = static_cast<uint16_t>(type);
    frame.size = static_cast<uint16_t>(2 * words.size());
    for (size_t i = 0; i < words.size(); ++i) {
        frame.payload[2 * i] = static_cast<uint8_t>(words[i] & 0xff);
        frame.payload[2 * i + 1] = static_cast<uint8_t>(words[i] >> 8);
    }
    return frame;
}

void program(hub::Hub& hub, hub::LinkId host, uint16_t node, const Words& bytecode) {
    Words words{node, 0};
    words.insert(words.end(), bytecode.begin(), bytecode.end());
    hub.receive(host, command(wire::MessageType::SetBytecode, words));
    hub.receive(host, command(wire::MessageType::Run, {node}));
}

struct Times {
    std::vector<uint64_t> cycles;
    uint64_t asked = 0;

    void see(uint8_t lamps, uint64_t cycle) {
        if (lamps == 1) asked = cycle;
        if (lamps == 2 && asked > 0) cycles.push_back(cycle - asked);
        if (lamps == 2) asked = 0;
    }
};

double ms(uint64_t cycles) {
    return static_cast<double>(cycles) / kCyclesOfMillisecond;
}

bool report(const Times& times, size_t bytes) {
    uint64_t most = 0, sum = 0;
    for (const uint64_t one : times.cycles) {
        most = one > most ? one : most;
        sum += one;
    }
    const size_t rounds = times.cycles.size();
    if (rounds < kRoundsMin) {
        std::printf("%zu answers came, expected at least %zu\n", rounds, kRoundsMin);
        return false;
    }
    std::printf(
        "figure: event to event over two AVR nodes and a switch: mean %.2f ms, worst %.2f ms, "
        "%zu bytes a node and round\n",
        ms(sum / rounds), ms(most), (bytes + rounds / 2) / rounds);
    return ms(most) > kLine_ms && ms(most) < kLine_ms + kNodes_ms;
}

bool measure(const std::string& image) {
    hub::Hub hub;
    const hub::LinkId host = hub.add({.name = "host"}).value();
    Node asks(image, 1, hub), answers(image, 2, hub);
    Times times;
    asks.chip().on_lamps = [&](uint8_t lamps) { times.see(lamps, asks.chip().cycle()); };
    size_t bytes_before = 0;
    for (uint64_t cycle = kSlice; cycle < kSeconds * kClock; cycle += kSlice) {
        if (cycle == 100 * kCyclesOfMillisecond) {
            program(hub, host, 1, kAsks);
            program(hub, host, 2, kAnswers);
            hub.receive(host, command(wire::MessageType::SetVariables, {1, kPeriodAt, 50}));
        }
        if (times.cycles.empty()) bytes_before = answers.bytes();
        asks.run_until(cycle);
        answers.run_until(cycle);
        wire::Frame heard;
        while (hub.take(host, heard)) {
        }
    }
    return report(times, answers.bytes() - bytes_before);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "vagus-avr-latency: expected one word: IMAGE.elf\n");
        return 2;
    }
    try {
        return measure(argv[1]) ? 0 : 1;
    } catch (const ChipError& error) {
        std::fprintf(stderr, "vagus-avr-latency: %s\n", error.what());
        return 2;
    }
}
