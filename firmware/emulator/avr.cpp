// An emulated ATmega1284P in real time, by simavr: its serial line is standard input and output.
// `vagus emulate` starts it, as it starts QEMU for the Cortex-M boards. A program of its own:
// simavr stands under the GNU General Public License.
//
//     vagus-avr IMAGE.elf [--id N] [--eeprom FILE] [--report]
//
// --id: the number that the maker gave the board. --eeprom: what the chip keeps without power, read
// at the start and written at the end. --report: says on standard error, at the end, how
// deep the stack was.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

extern "C" {
#include <simavr/avr_eeprom.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
}

namespace {

constexpr const char* kChip = "atmega1284p";
constexpr uint32_t kClock = 16'000'000;
constexpr uint32_t kCyclesOfMillisecond = kClock / 1000;
constexpr int kBytesOfMillisecond = 11;  // at 115,200 baud
constexpr int kLookAgain_ms = 100;
constexpr int kRamEnd = 0x40ff;
constexpr size_t kEepromBytes = 4096;
constexpr size_t kIdOfMaker = kEepromBytes - 2;
// A computer that was busy for longer does not make up for it.
constexpr uint64_t kBehindMax_ms = 100;

struct Options {
    std::string image;
    std::string eeprom;
    uint16_t id = 0xffff;
    bool report = false;
};

volatile sig_atomic_t ended = 0;
void on_signal(int) {
    ended = 1;
}

[[noreturn]] void give_up(const std::string& why) {
    std::fprintf(stderr, "vagus-avr: %s\n", why.c_str());
    std::exit(2);
}

Options options_of(int argc, char** argv) {
    Options options;
    const std::vector<std::string> words(argv + 1, argv + argc);
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
            give_up(words[i] + ": expected IMAGE.elf [--id N] [--eeprom FILE] [--report]");
        }
    }
    if (options.image.empty())
        give_up("expected the image of a program, for instance atmega1284p.elf");
    return options;
}

uint64_t now_ms() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<uint64_t>(now.tv_sec) * 1000 +
           static_cast<uint64_t>(now.tv_nsec) / 1'000'000;
}

class Emulator {
public:
    explicit Emulator(const Options& options) : options_(options) {
        load_program();
        load_eeprom();
        join_serial_line();
    }

    int run() {
        uint64_t began = now_ms() - done_ms();
        while (ended == 0 && !closed_) {
            const uint64_t wanted = now_ms() - began;
            if (wanted > done_ms() + kBehindMax_ms) began += wanted - done_ms();
            if (wanted <= done_ms()) {
                pause();
            } else {
                read_bytes();
                run_one_millisecond();
            }
        }
        if (options_.report) std::fprintf(stderr, "deepest stack: %d bytes\n", kRamEnd - deepest_);
        save_eeprom();
        return 0;
    }

private:
    void load_program() {
        elf_firmware_t firmware{};
        if (elf_read_firmware(options_.image.c_str(), &firmware) != 0) {
            give_up(options_.image + ": cannot be read as a program; ./dev firmware builds it");
        }
        firmware.frequency = kClock;
        avr_ = avr_make_mcu_by_name(kChip);
        if (avr_ == nullptr) give_up(std::string("this simavr knows no ") + kChip);
        avr_init(avr_);
        avr_load_firmware(avr_, &firmware);
        avr_->sleep = [](avr_t*, avr_cycle_count_t) {};  // run() keeps the pace
        avr_->log = LOG_ERROR;
    }

    void load_eeprom() {
        eeprom_.fill(0xff);
        if (options_.id != 0xffff) {
            eeprom_[kIdOfMaker] = static_cast<uint8_t>(options_.id & 0xff);
            eeprom_[kIdOfMaker + 1] = static_cast<uint8_t>(options_.id >> 8);
        }
        if (FILE* file =
                options_.eeprom.empty() ? nullptr : std::fopen(options_.eeprom.c_str(), "rb")) {
            if (std::fread(eeprom_.data(), 1, eeprom_.size(), file) != eeprom_.size()) {
                give_up(options_.eeprom +
                        ": expected 4096 bytes; delete it to begin with an empty one");
            }
            std::fclose(file);
        }
        avr_eeprom_desc_t all{eeprom_.data(), 0, static_cast<uint32_t>(eeprom_.size())};
        avr_ioctl(avr_, AVR_IOCTL_EEPROM_SET, &all);
    }

    void save_eeprom() {
        if (options_.eeprom.empty()) return;
        avr_eeprom_desc_t all{eeprom_.data(), 0, static_cast<uint32_t>(eeprom_.size())};
        avr_ioctl(avr_, AVR_IOCTL_EEPROM_GET, &all);
        FILE* file = std::fopen(options_.eeprom.c_str(), "wb");
        const bool written = file != nullptr &&
                             std::fwrite(eeprom_.data(), 1, eeprom_.size(), file) == eeprom_.size();
        if (file == nullptr || std::fclose(file) != 0 || !written)
            give_up(options_.eeprom + ": cannot be written");
    }

    void join_serial_line() {
        uint32_t flags = 0;
        avr_ioctl(avr_, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
        flags &= ~static_cast<uint32_t>(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POOL_SLEEP);
        avr_ioctl(avr_, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
        input_ = avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
        listen(UART_IRQ_OUTPUT, [](avr_irq_t*, uint32_t value, void* self) {
            static_cast<Emulator*>(self)->send(static_cast<uint8_t>(value));
        });
        fcntl(STDIN_FILENO, F_SETFL, fcntl(STDIN_FILENO, F_GETFL) | O_NONBLOCK);
    }

    void listen(int which, avr_irq_notify_t what) {
        avr_irq_register_notify(avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), which), what, this);
    }

    uint64_t done_ms() const { return avr_->cycle / kCyclesOfMillisecond; }

    void run_one_millisecond() {
        const avr_cycle_count_t end = avr_->cycle + kCyclesOfMillisecond;
        while (avr_->cycle < end) {
            const int state = avr_run(avr_);
            deepest_ = std::min(deepest_, stack_pointer());
            if (state == cpu_Done || state == cpu_Crashed) {
                give_up("the program crashed, or slept with interrupts off");
            }
        }
    }

    // 0 until the program has set it.
    int stack_pointer() const {
        const int pointer = avr_->data[R_SPL] | (avr_->data[R_SPH] << 8);
        return pointer == 0 ? kRamEnd : pointer;
    }

    static void pause() { ::poll(nullptr, 0, 1); }

    // As the line brings them, whether the chip is ready or not.
    void read_bytes() {
        for (int i = 0; i < kBytesOfMillisecond; ++i) {
            uint8_t byte = 0;
            const ssize_t got = ::read(STDIN_FILENO, &byte, 1);
            if (got == 0) closed_ = true;
            if (got != 1) return;
            avr_raise_irq(input_, byte);
        }
    }

    // Time stands still for the chip while nobody reads.
    void send(uint8_t byte) {
        while (!closed_ && ended == 0 && ::write(STDOUT_FILENO, &byte, 1) != 1) {
            if (errno != EAGAIN && errno != EINTR) closed_ = true;
            pollfd output{STDOUT_FILENO, POLLOUT, 0};
            ::poll(&output, 1, kLookAgain_ms);
        }
    }

    const Options& options_;
    avr_t* avr_ = nullptr;  // of simavr, which frees it with the process
    avr_irq_t* input_ = nullptr;
    std::array<uint8_t, kEepromBytes> eeprom_{};
    bool closed_ = false;
    int deepest_ = kRamEnd;
};

}  // namespace

int main(int argc, char** argv) {
    const Options options = options_of(argc, argv);
    struct sigaction end {};
    end.sa_handler = on_signal;
    sigaction(SIGTERM, &end, nullptr);
    sigaction(SIGINT, &end, nullptr);
    signal(SIGPIPE, SIG_IGN);
    Emulator emulator(options);
    return emulator.run();
}
