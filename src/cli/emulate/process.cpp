#include "cli/emulate/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace vagus::cli {

namespace {

constexpr int kCannotExec = 127;

Error system_error(const std::string& what) {
    return {Code::Unavailable, what + ": " + std::strerror(errno)};
}

// A file without a name that holds these bytes; -1 if there are none.
Result<int> file_with(const std::string& bytes) {
    if (bytes.empty()) return -1;
    const int file = memfd_create("vagus-id", MFD_CLOEXEC);
    if (file < 0 ||
        ::write(file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
        return system_error("cannot keep the number of a board");
    }
    return file;
}

// What an emulator gets: -1 is none.
struct Given {
    int line = -1;
    int file = -1;
    int monitor = -1;
};

void give(int descriptor, int number) {
    if (descriptor >= 0 && dup2(descriptor, number) == number) fcntl(number, F_SETFD, 0);
}

// Out of the way of the numbers that an emulator knows its descriptors by.
int moved_up(int descriptor) {
    if (descriptor < 0) return descriptor;
    const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, kMonitorDescriptor + 1);
    ::close(descriptor);
    return moved;
}

struct Pair {
    int own = -1;
    int far = -1;
};

Result<Pair> pair_of_sockets(const std::string& name) {
    int line[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line) != 0) {
        return system_error(name + ": cannot make a line");
    }
    return Pair{.own = line[0], .far = moved_up(line[1])};
}

void close_if_open(int descriptor) {
    if (descriptor >= 0) ::close(descriptor);
}

// Between fork and exec only what a signal handler might call, too.
[[noreturn]] void become(char* const* words, Given given, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(kCannotExec);  // it died before the line above
    setpgid(0, 0);  // an interrupt of the terminal is for the switch, which ends its boards
    dup2(given.line, STDIN_FILENO);
    dup2(given.line, STDOUT_FILENO);
    give(given.file, kIdDescriptor);
    give(given.monitor, kMonitorDescriptor);
    execvp(words[0], words);
    _exit(kCannotExec);
}

}  // namespace

Result<EmulatorProcess> EmulatorProcess::start(const Emulation& emulation) {
    const Pair line = TRY(pair_of_sockets(emulation.name));
    const Pair monitor =
        emulation.memory ? TRY(pair_of_sockets(emulation.name)) : Pair{.own = -1, .far = -1};
    const int file = moved_up(TRY(file_with(emulation.id_bytes)));
    std::vector<std::string> words = emulation.words;
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process == 0) {
        become(pointers.data(), {.line = line.far, .file = file, .monitor = monitor.far}, parent);
    }
    for (const int given : {line.far, file, monitor.far}) close_if_open(given);
    if (process < 0) {
        for (const int own : {line.own, monitor.own}) close_if_open(own);
        return system_error(emulation.name + ": cannot be started");
    }
    return EmulatorProcess(process, line.own, monitor.own);
}

EmulatorProcess::~EmulatorProcess() {
    for (const int own : {line_, monitor_}) close_if_open(own);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

EmulatorProcess::EmulatorProcess(EmulatorProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      line_(std::exchange(other.line_, -1)),
      monitor_(std::exchange(other.monitor_, -1)) {}

EmulatorProcess& EmulatorProcess::operator=(EmulatorProcess&& other) noexcept {
    std::swap(process_, other.process_);
    std::swap(line_, other.line_);
    std::swap(monitor_, other.monitor_);
    return *this;
}

int EmulatorProcess::take_line() {
    return std::exchange(line_, -1);
}

int EmulatorProcess::take_monitor() {
    return std::exchange(monitor_, -1);
}

}  // namespace vagus::cli
