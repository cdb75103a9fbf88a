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

// Between fork and exec only what a signal handler might call, too.
[[noreturn]] void become(char* const* words, int line, int file, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(kCannotExec);  // it died before the line above
    setpgid(0, 0);  // an interrupt of the terminal is for the switch, which ends its boards
    dup2(line, STDIN_FILENO);
    dup2(line, STDOUT_FILENO);
    if (file >= 0 && dup2(file, kIdDescriptor) == kIdDescriptor) fcntl(kIdDescriptor, F_SETFD, 0);
    execvp(words[0], words);
    _exit(kCannotExec);
}

}  // namespace

Result<EmulatorProcess> EmulatorProcess::start(const Emulation& emulation) {
    int line[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line) != 0) {
        return system_error(emulation.name + ": cannot make a line");
    }
    const int file = TRY(file_with(emulation.id_bytes));
    std::vector<std::string> words = emulation.words;
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process == 0) become(pointers.data(), line[1], file, parent);
    ::close(line[1]);
    if (file >= 0) ::close(file);
    if (process < 0) {
        ::close(line[0]);
        return system_error(emulation.name + ": cannot be started");
    }
    return EmulatorProcess(process, line[0]);
}

EmulatorProcess::~EmulatorProcess() {
    if (line_ >= 0) ::close(line_);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

EmulatorProcess::EmulatorProcess(EmulatorProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)), line_(std::exchange(other.line_, -1)) {}

EmulatorProcess& EmulatorProcess::operator=(EmulatorProcess&& other) noexcept {
    std::swap(process_, other.process_);
    std::swap(line_, other.line_);
    return *this;
}

int EmulatorProcess::take_line() {
    return std::exchange(line_, -1);
}

}  // namespace vagus::cli
