// The motors of an emulated ATmega1284P: the compare registers of its PWM are 0 within one control
// period after whatever ends the program's command, and stay so until the program writes again.
// Times are cycles of the chip.
//
//     vagus-avr-motors IMAGE.elf
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "chip.hpp"
#include "wire/frame.hpp"
#include "wire/protocol.hpp"

namespace {

using namespace vagus;
using namespace vagus::emulator;
using wire::MessageType;
using Words = std::vector<uint16_t>;

constexpr uint64_t kCyclesOfByte = kClock / 11'520;
constexpr uint16_t kNode = 1;
constexpr uint16_t kMotorsAt = 39, kHalts = 60;
constexpr uint16_t kDrive = 5, kFault = 6;
constexpr uint64_t kPeriod = 20 * kCyclesOfMillisecond;  // the control period
constexpr uint64_t kLong = 200 * kCyclesOfMillisecond;
constexpr uint64_t kWatchdog = 1300 * kCyclesOfMillisecond;  // a second, as coarse as it is

// onevent halted: variable 60 += 1; onevent 5: left = 100, right = -50; onevent 6: left = 1 / 0.
const Words kScript = {7,      0xfffc, 17,     kDrive, 7,      kFault, 12,     0x1064,
                       0x4027, 0x1fce, 0x4028, 0,      0x1001, 0x1000, 0x8005, 0x4027,
                       0,      0x303c, 0x1001, 0x8002, 0x403c, 0};
constexpr uint16_t kInDrive = 8;  // a word of the handler of event 5

class Robot {
public:
    explicit Robot(const std::string& image) : chip_(image, eeprom_with_number(kNode)) {
        chip_.on_sent = [](uint8_t) {};
        wait(kLong);
    }
    void send(uint16_t type, const Words& words, uint16_t source = wire::kHostId) {
        wire::Frame frame{};
        frame.source = source;
        frame.type = type;
        frame.size = static_cast<uint16_t>(2 * words.size());
        for (size_t i = 0; i < words.size(); ++i) {
            frame.payload[2 * i] = static_cast<uint8_t>(words[i] & 0xff);
            frame.payload[2 * i + 1] = static_cast<uint8_t>(words[i] >> 8);
        }
        uint8_t bytes[wire::kFrameMax];
        const uint16_t size = wire::encode(frame, bytes);
        for (uint16_t i = 0; i < size; ++i) {
            chip_.receive(bytes[i]);
            wait(kCyclesOfByte);
        }
    }
    void tell(MessageType type, Words rest = {}) {
        rest.insert(rest.begin(), kNode);
        send(static_cast<uint16_t>(type), rest);
    }
    void load(Words program) {
        program.insert(program.begin(), 0);
        tell(MessageType::SetBytecode, program);
        tell(MessageType::GetExecutionState);  // the witness that the piece is whole
    }
    void start() {
        load(kScript);
        tell(MessageType::Run);
        wait(kPeriod);
    }
    void drive() {
        send(kDrive, {}, 3);
        wait(kPeriod);
    }
    bool drives() const { return chip_.power(0) == 100 && chip_.power(1) == 50; }
    bool is_still() const { return chip_.power(0) == 0 && chip_.power(1) == 0; }
    // Still after one period, and for long behind it.
    bool stops() {
        wait(kPeriod);
        for (uint64_t end = chip_.cycle() + kLong; chip_.cycle() < end; wait(1000)) {
            if (!is_still()) return false;
        }
        return true;
    }
    void wait(uint64_t cycles) { chip_.run_until(chip_.cycle() + cycles); }
    Chip& chip() { return chip_; }

private:
    Chip chip_;
};

struct Ending {
    const char* name;
    std::function<void(Robot&)> end;
    bool run_again = true;
};

const std::vector<Ending> kEndings = {
    {"Stop", [](Robot& robot) { robot.tell(MessageType::Stop); }},
    {"Reset", [](Robot& robot) { robot.tell(MessageType::Reset); }},
    {"Pause", [](Robot& robot) { robot.tell(MessageType::Pause); }},
    {"a new program", [](Robot& robot) { robot.load(kScript); }},
    {"an erased program", [](Robot& robot) { robot.load({0}); }, false},
    {"a fault", [](Robot& robot) { robot.send(kFault, {}, 3); }},
    {"a breakpoint",
     [](Robot& robot) {
         robot.tell(MessageType::BreakpointSet, {kInDrive});
         robot.send(kDrive, {}, 3);
     },
     false},
};

bool fail(const std::string& sentence) {
    std::printf("%s\n", sentence.c_str());
    return false;
}

bool stops_by(const std::string& image, const Ending& ending) {
    Robot robot(image);
    if (!robot.is_still()) return fail("the motors run before a program is there");
    robot.start();
    robot.drive();
    const std::string name = ending.name;
    if (!robot.drives()) return fail(name + ": the program does not reach the motors");
    ending.end(robot);
    if (!robot.stops()) return fail(name + ": the motors run on");
    if (!ending.run_again) return true;
    robot.tell(MessageType::Run);
    if (!robot.stops()) return fail(name + ": the motors run again, and nobody wrote");
    robot.drive();
    return robot.drives() || fail(name + ": the motors do not run again");
}

// Nothing but interrupts goes on: the watchdog starts the board again.
bool stops_by_the_watchdog(const std::string& image) {
    Robot robot(image);
    robot.start();
    robot.drive();
    if (!robot.drives()) return fail("watchdog: the program does not reach the motors");
    robot.chip().hang();
    robot.wait(kPeriod);
    if (!robot.drives()) return fail("watchdog: it was not the watchdog that stopped the motors");
    robot.wait(kWatchdog);
    if (!robot.stops()) return fail("watchdog: the motors run on");
    robot.start();
    robot.drive();
    return robot.drives() || fail("watchdog: the board does not live again");
}

bool all_stop(const std::string& image) {
    bool good = true;
    for (const Ending& ending : kEndings) good = stops_by(image, ending) && good;
    return stops_by_the_watchdog(image) && good;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "vagus-avr-motors: expected one word: IMAGE.elf\n");
        return 2;
    }
    try {
        return all_stop(argv[1]) ? 0 : 1;
    } catch (const ChipError& error) {
        std::fprintf(stderr, "vagus-avr-motors: %s\n", error.what());
        return 2;
    }
}
