// An emulated ATmega1284P in real time: its serial line is standard input and output. `vagus
// emulate` starts it, as it starts QEMU for the Cortex-M boards. A program of its own: simavr
// is under the GNU General Public License.
//
//     vagus-avr IMAGE.elf [--id N] [--eeprom FILE] [--report]
//
// --id: the number that the maker gave the board. --eeprom: what the chip keeps without power, read
// at the start, and written when it has changed, before the next byte goes out: whoever reads that
// the board has saved finds it in the file, however this program ends then. --report: says on
// standard error, at the end, how deep the stack was.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <optional>
#include <vector>

#include "chip.hpp"

namespace {

using namespace vagus::emulator;

// A computer that was busy for longer does not make up for it.
constexpr uint64_t kBehindMax_ms = 100;
constexpr int kLookAgain_ms = 100;
constexpr uint16_t kNoNumber = 0xffff;
constexpr const char* kUsage = "expected IMAGE.elf [--id N] [--eeprom FILE] [--report]";

struct Options {
    std::string image;
    std::string eeprom;
    uint16_t id = kNoNumber;
    bool report = false;
};

volatile sig_atomic_t ended = 0;
void on_signal(int) {
    ended = 1;
}

Options options_of(const std::vector<std::string>& words) {
    Options options;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool more = i + 1 < words.size();
        if (words[i] == "--id" && more) {
            options.id = static_cast<uint16_t>(std::atoi(words[++i].c_str()));
        } else if (words[i] == "--eeprom" && more) {
            options.eeprom = words[++i];
        } else if (words[i] == "--report") {
            options.report = true;
        } else if (options.image.empty()) {
            options.image = words[i];
        } else {
            throw ChipError(words[i] + ": " + kUsage);
        }
    }
    if (options.image.empty()) throw ChipError(kUsage);
    return options;
}

uint64_t now_ms() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<uint64_t>(now.tv_sec) * 1000 +
           static_cast<uint64_t>(now.tv_nsec) / 1'000'000;
}

// What was kept in the file, or what the maker delivers.
Eeprom eeprom_of(const Options& options) {
    Eeprom eeprom = eeprom_with_number(options.id);
    FILE* const file = options.eeprom.empty() ? nullptr : std::fopen(options.eeprom.c_str(), "rb");
    if (file == nullptr) return eeprom;
    const size_t read = std::fread(eeprom.data(), 1, eeprom.size(), file);
    std::fclose(file);
    if (read == eeprom.size()) return eeprom;
    throw ChipError(options.eeprom + ": has " + std::to_string(read) +
                    " bytes, expected 4096; delete it to begin with an empty one");
}

// Beside the file, then in its place: who is killed in between leaves the old one.
void keep(const std::string& name, const Eeprom& eeprom) {
    const std::string beside = name + ".new";
    FILE* const file = std::fopen(beside.c_str(), "wb");
    const bool written =
        file != nullptr && std::fwrite(eeprom.data(), 1, eeprom.size(), file) == eeprom.size();
    if (file == nullptr || std::fclose(file) != 0 || !written ||
        std::rename(beside.c_str(), name.c_str()) != 0) {
        throw ChipError(name + ": what the board saved cannot be written: " + std::strerror(errno));
    }
}

class Board {
public:
    Board(const Options& options, int line)
        : kept_(eeprom_of(options)),
          chip_(options.image, kept_),
          keep_in_(options.eeprom),
          line_(line) {
        chip_.on_sent = [this](uint8_t byte) { send(byte); };
        fcntl(STDIN_FILENO, F_SETFL, fcntl(STDIN_FILENO, F_GETFL) | O_NONBLOCK);
    }

    void run() {
        uint64_t began = now_ms();
        for (uint64_t done_ms = 0; ended == 0 && !closed_;) {
            const uint64_t wanted = now_ms() - began;
            if (wanted > done_ms + kBehindMax_ms) began += wanted - done_ms;
            if (wanted <= done_ms) {
                ::poll(nullptr, 0, 1);
                continue;
            }
            receive();
            chip_.run_until(++done_ms * kCyclesOfMillisecond);
        }
    }

    void keep_what_changed() {
        if (keep_in_.empty()) return;
        const Eeprom now = chip_.eeprom();
        if (now == kept_) return;
        keep(keep_in_, now);
        kept_ = now;
    }

    const Chip& chip() const { return chip_; }

private:
    void receive() {
        for (uint32_t i = 0; i < kBytesOfMillisecond && chip_.takes_bytes(); ++i) {
            uint8_t byte = 0;
            const ssize_t got = ::read(STDIN_FILENO, &byte, 1);
            if (got == 0) closed_ = true;
            if (got != 1) return;
            chip_.receive(byte);
        }
    }

    // The chip's clock is paused while nobody reads.
    void send(uint8_t byte) {
        keep_what_changed();
        while (!closed_ && ended == 0 && ::write(line_, &byte, 1) != 1) {
            if (errno != EAGAIN && errno != EINTR) closed_ = true;
            pollfd output{line_, POLLOUT, 0};
            ::poll(&output, 1, kLookAgain_ms);
        }
    }

    Eeprom kept_;  // as the file has it
    Chip chip_;
    std::string keep_in_;  // empty: nowhere
    int line_;
    bool closed_ = false;
};

// simavr prints on standard output, too: nothing but the line's bytes may go there.
int line_alone() {
    const int line = dup(STDOUT_FILENO);
    if (line < 0 || std::freopen("/dev/null", "w", stdout) == nullptr) {
        throw ChipError("standard output cannot be kept for the serial line");
    }
    return line;
}

void emulate(const Options& options) {
    Board board(options, line_alone());
    board.run();
    if (options.report) {
        std::fprintf(stderr, "deepest stack: %d bytes\n", board.chip().deepest_stack());
    }
    board.keep_what_changed();
}

}  // namespace

int main(int argc, char** argv) {
    struct sigaction end {};
    end.sa_handler = on_signal;
    sigaction(SIGTERM, &end, nullptr);
    sigaction(SIGINT, &end, nullptr);
    signal(SIGPIPE, SIG_IGN);
    try {
        emulate(options_of({argv + 1, argv + argc}));
    } catch (const ChipError& error) {
        std::fprintf(stderr, "vagus-avr: %s\n", error.what());
        return 2;
    }
    return 0;
}
