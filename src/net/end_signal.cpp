#include "net/end_signal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <utility>

namespace vagus::net {

namespace {

// What the handler reaches. The pipe is never closed.
volatile sig_atomic_t g_end_signal = 0;  // the first that asked for the end
volatile sig_atomic_t g_wake = -1;       // the writing end of the pipe
int g_asked = -1;                        // its reading end; a byte stays in it once asked
void (*volatile g_last_act)() = nullptr;
volatile int64_t g_asked_at_ms = 0;  // when the first came
constexpr int64_t kSameHangUpMs = 100;

// Of a terminal that closes both its shell and the system send a SIGHUP.
bool is_same_hang_up(int signal_number) {
    timespec now = {};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    const int64_t ms = int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
    if (g_end_signal == 0) g_asked_at_ms = ms;
    return signal_number == SIGHUP && g_end_signal == SIGHUP && ms - g_asked_at_ms < kSameHangUpMs;
}

void on_end(int signal_number) {
    const int before = errno;
    const bool same = is_same_hang_up(signal_number);
    if (g_end_signal != 0 && !same) {
        if (g_last_act) g_last_act();
        die_by(signal_number);
    }
    g_end_signal = signal_number;
    [[maybe_unused]] const auto written = ::write(g_wake, "!", 1);
    errno = before;
}

}  // namespace

bool is_ignored(int signal_number) {
    struct sigaction now = {};
    return ::sigaction(signal_number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

void die_by(int signal_number) {
    ::signal(signal_number, SIG_DFL);
    sigset_t set;
    ::sigemptyset(&set);
    ::sigaddset(&set, signal_number);
    ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
    ::raise(signal_number);
}

void watch_for_end(EndBy by) {
    if (g_asked < 0) {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return;  // no descriptors: dies as before
        g_asked = ends[0];
        g_wake = ends[1];
    }
    struct sigaction action = {};
    action.sa_handler = on_end;
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
        const bool nohup = signal_number == SIGHUP && is_ignored(SIGHUP);
        const bool kept = signal_number == SIGINT && by == EndBy::AnyButCtrlC;
        if (!nohup && !kept) ::sigaction(signal_number, &action, nullptr);
    }
}

bool end_asked() {
    return g_end_signal != 0;
}

std::string end_asked_by() {
    const int by = g_end_signal;
    if (by == SIGINT) return "SIGINT";
    if (by == SIGTERM) return "SIGTERM";
    return by == SIGHUP ? "SIGHUP" : "";
}

int end_descriptor() {
    return g_asked;
}

int end_as_asked(int exit_code) {
    if (g_end_signal != 0) die_by(g_end_signal);
    return exit_code;
}

void before_sudden_end(void (*last_act)()) {
    g_last_act = last_act;
}

EndWatcher::EndWatcher(std::function<void()> on_end) {
    if (g_asked < 0 || ::pipe2(quit_, O_CLOEXEC) != 0) return;
    thread_ = std::thread([quit = quit_[0], on_end = std::move(on_end)] {
        pollfd ready[2] = {{quit, POLLIN, 0}, {g_asked, POLLIN, 0}};
        while (::poll(ready, 2, -1) < 0 && errno == EINTR) {
        }
        if (ready[1].revents != 0) on_end();
    });
}

EndWatcher::~EndWatcher() {
    if (!thread_.joinable()) return;
    ::close(quit_[1]);  // wakes it
    thread_.join();
    ::close(quit_[0]);
}

}  // namespace vagus::net
