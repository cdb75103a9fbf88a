#include "cli/fleet/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "base/text.hpp"
#include "cli/programs.hpp"

namespace vagus::cli {
namespace {

constexpr int kCannotExec = 127;
constexpr size_t kLastWordsMax = 2000;

Error system_error(const std::string& what) {
    return {Code::Unavailable, what + ": " + std::strerror(errno)};
}

Error not_installed(const std::string& name) {
    const bool broker = name.starts_with("mosquitto");
    return {
        Code::NotFound,
        fmt::format("{} is not installed: apt-get install {}{}", name, broker ? "mosquitto" : name,
                    broker ? " (and, if its service is not wanted, systemctl disable "
                             "--now mosquitto)"
                           : "")};
}

// `output` -1: where this program says what it has to say.
Result<pid_t> start(const std::vector<std::string>& given, int output, int last_signal) {
    std::vector<std::string> words = given;
    if (given[0].find('/') == std::string::npos) {
        const auto found = find_program(given[0]);
        if (!found) return not_installed(given[0]);
        words[0] = *found;
    }
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process < 0) return system_error(given[0] + ": cannot be started");
    if (process > 0) return process;
    // Between fork and exec only what a signal handler might call, too.
    prctl(PR_SET_PDEATHSIG, last_signal);
    if (getppid() != parent) _exit(kCannotExec);
    setpgid(0, 0);  // an interrupt of the terminal is for this program, which ends it in order
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(output >= 0 ? output : STDERR_FILENO, STDOUT_FILENO);
    if (output >= 0) dup2(output, STDERR_FILENO);
    execv(pointers[0], pointers.data());
    _exit(kCannotExec);
}

std::string how_it_ended(int status) {
    if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
    return fmt::format("exited with status {}", WEXITSTATUS(status));
}

std::string read_all(int descriptor) {
    std::string text;
    char buffer[4096];
    for (ssize_t count = 0; (count = read(descriptor, buffer, sizeof buffer)) > 0;) {
        text.append(buffer, static_cast<size_t>(count));
        if (text.size() > kLastWordsMax) text.erase(0, text.size() - kLastWordsMax);
    }
    return text;
}

}  // namespace

Status run_to_end(const std::vector<std::string>& words) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return system_error(words[0]);
    const auto process = start(words, ends[1], SIGKILL);
    close(ends[1]);
    const std::string said = process.ok() ? read_all(ends[0]) : "";
    close(ends[0]);
    if (!process.ok()) return process.error();
    int status = 0;
    waitpid(process.value(), &status, 0);
    if (status == 0) return Status::done();
    return Error{Code::Unavailable,
                 fmt::format("{} {}:\n{}", words[0], how_it_ended(status), said)};
}

// ---- Companion ----

Result<Companion> Companion::start(const std::vector<std::string>& words) {
    return Companion(TRY(cli::start(words, -1, SIGTERM)));
}

Companion::~Companion() {
    end();
}

Companion::Companion(Companion&& other) noexcept : process_(std::exchange(other.process_, -1)) {}

Companion& Companion::operator=(Companion&& other) noexcept {
    std::swap(process_, other.process_);
    return *this;
}

std::optional<std::string> Companion::ended() {
    int status = 0;
    if (process_ <= 0 || waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
    process_ = -1;
    return how_it_ended(status);
}

void Companion::end() {
    if (process_ <= 0) return;
    kill(process_, SIGTERM);
    waitpid(std::exchange(process_, -1), nullptr, 0);
}

}  // namespace vagus::cli
