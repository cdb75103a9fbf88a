// A byte comes in between the two loads of a number of 16 bits that its interrupt counts up: an
// AVR loads a byte at a time, and 255 that becomes 256 in between would be read as 511. The
// emulated ATmega1284P is stopped there, whichever instructions they are, and the interrupt is
// raised; the node must still read the frame as it was sent.
//
//     vagus-avr-interrupted IMAGE.elf
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "chip.hpp"
#include "wire/frame.hpp"
#include "wire/protocol.hpp"

namespace {

using namespace vagus;
using namespace vagus::emulator;
using Bytes = std::vector<uint8_t>;

// simavr tells the program of a byte one byte later.
constexpr uint64_t kCyclesOfByte = 2 * kClock / 11'520;
constexpr uint16_t kNode = 1;
constexpr uint16_t kFirst = 100;  // variables that nobody describes
constexpr uint16_t kWords = 140;
constexpr uint16_t kBefore = 255;  // bytes that have come; the next one carries
constexpr int kWordsOfCommand = 2;
constexpr uint64_t kWithin = 40 * kCyclesOfMillisecond;

Bytes command(wire::MessageType type, const std::vector<uint16_t>& words) {
    wire::Frame frame{};
    frame.type = static_cast<uint16_t>(type);
    frame.size = static_cast<uint16_t>(2 * words.size());
    for (size_t i = 0; i < words.size(); ++i) {
        frame.payload[2 * i] = static_cast<uint8_t>(words[i] & 0xff);
        frame.payload[2 * i + 1] = static_cast<uint8_t>(words[i] >> 8);
    }
    Bytes bytes(wire::kFrameMax);
    bytes.resize(wire::encode(frame, bytes.data()));
    return bytes;
}

Bytes set_variables() {
    std::vector<uint16_t> words = {kNode, kFirst};
    for (uint16_t i = 0; i < kWords; ++i) words.push_back(static_cast<uint16_t>(1000 + i));
    return command(wire::MessageType::SetVariables, words);
}

class Line {
public:
    explicit Line(Chip& chip) : chip_(chip) {
        chip_.on_sent = [this](uint8_t byte) { reader_.feed(&byte, 1); };
        wait(100 * kCyclesOfMillisecond);
    }
    void put(uint8_t byte) {
        chip_.receive(byte);
        wait(kCyclesOfByte);
    }
    void put(const Bytes& bytes, size_t from, size_t to) {
        for (size_t i = from; i < to; ++i) put(bytes[i]);
    }
    void wait(uint64_t cycles) { chip_.run_until(chip_.cycle() + cycles); }
    // What the node says to this; no words if it says nothing.
    std::vector<uint16_t> ask(const Bytes& bytes) {
        reader_ = {};
        put(bytes, 0, bytes.size());
        wait(kWithin);
        std::vector<uint16_t> words;
        if (!reader_.complete()) return words;
        const wire::Frame& frame = reader_.frame();
        for (uint16_t i = 0; i + 1 < frame.size; i = static_cast<uint16_t>(i + 2)) {
            words.push_back(static_cast<uint16_t>(frame.payload[i] | (frame.payload[i + 1] << 8)));
        }
        return words;
    }

private:
    Chip& chip_;
    wire::FrameReader reader_;
};

// The number of bytes in the row: the word in RAM that was `count` after so many bytes, each time.
std::vector<uint16_t> keep_those_with(const Chip& chip, std::vector<uint16_t> places,
                                      uint16_t count) {
    std::erase_if(places, [&](uint16_t place) { return chip.word(place) != count; });
    return places;
}

// Of these the one that changes first when a byte comes: others are copies of it.
uint16_t first_to_change(Chip& chip, const std::vector<uint16_t>& places, uint16_t count) {
    for (const uint64_t end = chip.cycle() + 2 * kCyclesOfByte; chip.cycle() < end; chip.step()) {
        for (const uint16_t place : places) {
            if (chip.word(place) != count) return place;
        }
    }
    return 0;
}

// Stops before the second of the two loads of this number; false if there are none.
bool stop_between_loads(Chip& chip, uint16_t place) {
    uint16_t loaded = 0;
    for (const uint64_t end = chip.cycle() + kWithin; chip.cycle() < end; chip.step()) {
        const uint16_t next = chip.next_load();
        if (loaded == place && next == place + 1) return true;
        if (loaded == place + 1 && next == place) return true;
        if (next != 0) loaded = next;
    }
    return false;
}

bool fail(const std::string& sentence) {
    std::printf("%s\n", sentence.c_str());
    return false;
}

bool reads_whole_numbers(const std::string& image) {
    Chip chip(image, eeprom_with_number(kNode));
    Line line(chip);
    const Bytes bytes = set_variables();
    std::vector<uint16_t> places;
    for (uint16_t place = kRamBegin; place < kRamBegin + kRamBytes - 1; ++place)
        places.push_back(place);
    for (uint16_t count = 0; count + 1 < kBefore; ++count) {
        line.put(bytes[count]);
        places = keep_those_with(chip, places, static_cast<uint16_t>(count + 1));
    }
    chip.receive(bytes[kBefore - 1]);
    const uint16_t at = first_to_change(chip, places, kBefore - 1);
    if (at == 0) return fail("no number in RAM counts the bytes of the line");
    line.wait(kCyclesOfByte);
    if (!stop_between_loads(chip, at)) return fail("the loop never loads the number of bytes");
    chip.receive_now(bytes[kBefore]);
    line.wait(kCyclesOfByte);
    if (chip.word(at) != kBefore + 1) return fail("the interrupt did not count the byte");
    line.put(bytes, kBefore + 1, bytes.size());
    line.wait(kWithin);
    const auto told =
        line.ask(command(wire::MessageType::GetVariables, {kNode, kFirst, kWordsOfCommand}));
    if (told == std::vector<uint16_t>{kFirst, 1000, 1001}) return true;
    return fail("255 that became 256 was not read as one of them: the frame is lost");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "vagus-avr-interrupted: expected one word: IMAGE.elf\n");
        return 2;
    }
    try {
        return reads_whole_numbers(argv[1]) ? 0 : 1;
    } catch (const ChipError& error) {
        std::fprintf(stderr, "vagus-avr-interrupted: %s\n", error.what());
        return 2;
    }
}
