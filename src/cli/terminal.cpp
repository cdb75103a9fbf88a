#include "cli/terminal.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <utility>

#include "cli/screen/theme.hpp"
#include "net/end_signal.hpp"

namespace vagus::cli {
namespace {

// Alternate screen, hidden cursor, no line wrap; and all of it back.
constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[2J";
constexpr std::string_view kLeave = "\x1b[0m\x1b[?7h\x1b[?25h\x1b[?1049l";
// A whole page appears at once on terminals that know this mode; others ignore it.
constexpr std::string_view kBegin = "\x1b[?2026h";
constexpr std::string_view kEnd = "\x1b[?2026l";
constexpr int kWriteWaitMs =
    1000;  // a terminal that takes nothing for so long (Ctrl-S) loses a page

// Signal handlers reach these. They change only in open(), close and the handlers, all of one
// thread.
termios g_before;                   // the terminal as it was found
volatile sig_atomic_t g_taken = 0;  // the terminal is ours at this moment
volatile sig_atomic_t g_lost = 0;   // the page on it is gone

// Only calls that are allowed in a signal handler.
void give_back() {
    if (g_taken == 0) return;
    g_taken = 0;
    [[maybe_unused]] const auto written = ::write(STDOUT_FILENO, kLeave.data(), kLeave.size());
    ::tcsetattr(STDIN_FILENO, TCSANOW, &g_before);
}

void take() {
    termios raw = g_before;
    raw.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON);
    raw.c_iflag &= ~static_cast<tcflag_t>(IXON | ICRNL);
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    ::tcsetattr(STDIN_FILENO, TCSANOW, &raw);
    [[maybe_unused]] const auto written = ::write(STDOUT_FILENO, kEnter.data(), kEnter.size());
    g_taken = 1;
    g_lost = 1;
}

void on_crash(int signal_number) {
    give_back();
    net::die_by(signal_number);
}

void on_stop(int signal_number) {
    const int before = errno;
    give_back();
    net::die_by(signal_number);  // returns when the process is continued
    errno = before;
}

// SIGCONT waits while the terminal is being given back: taken in between, it would be lost again.
void catch_stop() {
    struct sigaction stop = {};
    stop.sa_handler = on_stop;
    ::sigemptyset(&stop.sa_mask);
    ::sigaddset(&stop.sa_mask, SIGCONT);
    ::sigaction(SIGTSTP, &stop, nullptr);
}

void on_continue(int) {
    const int before = errno;
    catch_stop();
    // In the background a change of the terminal would stop us again.
    if (g_taken == 0 && ::tcgetpgrp(STDIN_FILENO) == ::getpgrp()) take();
    errno = before;
}

void catch_signal(int signal_number, void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    ::sigaction(signal_number, &action, nullptr);
}

constexpr int kCrashes[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGQUIT};

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

// What is typed until then, as soon as there is some.
std::string read_within(Duration wait) {
    std::string bytes(4096, '\0');
    pollfd ready{STDIN_FILENO, POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(wait / std::chrono::milliseconds(1))) <= 0) return {};
    const auto count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    bytes.resize(count > 0 ? static_cast<size_t>(count) : 0);
    return bytes;
}

}  // namespace

bool Terminal::can_draw() {
    const std::string term = environment("TERM");
    const bool moves = !term.empty() && term != "dumb";
    return moves && ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1;
}

Result<Terminal> Terminal::open() {
    if (::isatty(STDOUT_FILENO) != 1 || ::tcgetattr(STDIN_FILENO, &g_before) != 0) {
        return Error{Code::Unavailable, "no terminal to draw on: give --headless for plain lines"};
    }
    for (const int crash : kCrashes) catch_signal(crash, on_crash);
    catch_stop();
    catch_signal(SIGCONT, on_continue);
    net::before_sudden_end(give_back);
    take();
    g_lost = 0;
    return Terminal();
}

Terminal::Terminal(Terminal&& other) noexcept
    : open_(other.open_), typed_(std::move(other.typed_)) {
    other.open_ = false;
}

Terminal::~Terminal() {
    if (!open_) return;
    give_back();
    net::before_sudden_end(nullptr);
    for (const int crash : kCrashes) ::signal(crash, SIG_DFL);
    ::signal(SIGTSTP, SIG_DFL);
    ::signal(SIGCONT, SIG_DFL);
}

Size Terminal::size() const {
    winsize window = {};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0) return {};
    return {window.ws_col, window.ws_row};
}

bool Terminal::write(std::string_view bytes) {
    if (bytes.empty() || g_taken == 0) return true;  // in the background the screen is not ours
    const std::string page = std::string(kBegin) + std::string(bytes) + std::string(kEnd);
    std::string_view left = page;
    while (!left.empty()) {
        const auto count = ::write(STDOUT_FILENO, left.data(), left.size());
        if (count > 0) {
            left.remove_prefix(static_cast<size_t>(count));
            continue;
        }
        if (errno == EINTR) continue;
        if (errno != EAGAIN) return false;
        pollfd ready{STDOUT_FILENO, POLLOUT, 0};
        if (::poll(&ready, 1, kWriteWaitMs) == 0) {
            g_lost = 1;
            return true;
        }
    }
    return true;
}

std::string Terminal::read() {
    if (g_taken == 0) return {};
    return std::exchange(typed_, "") + read_within(Duration{});
}

std::optional<Theme> Terminal::ask_background() {
    using Clock = std::chrono::steady_clock;
    if (::write(STDOUT_FILENO, kAskBackground.data(), kAskBackground.size()) < 0) return {};
    const auto end = Clock::now() + kAnswerWait;
    std::string bytes;
    BackgroundAnswer answer;
    while (!answer.complete && Clock::now() < end) {
        bytes += read_within(std::chrono::duration_cast<Duration>(end - Clock::now()));
        answer = read_background(bytes);
    }
    typed_ += answer.typed;
    return answer.theme;
}

bool Terminal::take_lost() {
    const bool lost = g_lost != 0;
    g_lost = 0;
    return lost;
}

Look look_of(Terminal& terminal, const std::string& theme) {
    std::string locale;
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
        if (locale.empty()) locale = environment(name);
    }
    Look look = look_for({environment("TERM"), environment("COLORTERM"), environment("NO_COLOR"),
                          environment("COLORFGBG"), locale});
    if (!theme.empty()) {
        look.theme = theme == "light" ? Theme::Light : Theme::Dark;
    } else if (look.depth != ColourDepth::None) {
        look.theme = terminal.ask_background().value_or(look.theme);
    }
    return look;
}

}  // namespace vagus::cli
