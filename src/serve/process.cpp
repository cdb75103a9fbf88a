#include "serve/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace vagus::serve {

namespace {

constexpr size_t kReadBytes = 64 * 1024;
constexpr size_t kHeadBytes = 5;
constexpr size_t kTidyBytes = 1u << 20;  // written bytes are forgotten in pieces of this

Error system_error(const std::string& what) {
    return {Code::Unavailable, what + ": " + std::strerror(errno)};
}

// A sanitizer takes terabytes of addresses for itself, and little memory.
constexpr bool kLimitsAddresses = VAGUS_SANITIZED == 0;
constexpr int kDescriptorsSearched = 4096;  // where the kernel cannot mark a range

// What this process has open from there on stays its own: a page's connection that a child holds,
// too, never closes. Libraries do not mark all that they open.
void keep_from_children(int first) {
    if (close_range(static_cast<unsigned>(first), ~0u, CLOSE_RANGE_CLOEXEC) == 0) return;
    for (int one = first; one < kDescriptorsSearched; ++one) fcntl(one, F_SETFD, FD_CLOEXEC);
}

// Between fork and exec only what a signal handler might call, too.
[[noreturn]] void become(const char* program, char* const* arguments, int talk, size_t memory,
                         pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // It died before the line above. It may itself be process 1, as in a container.
    if (getppid() != parent) _exit(127);
    const rlimit limit{memory, memory};
    if (kLimitsAddresses) setrlimit(RLIMIT_AS, &limit);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    // A signal of the terminal is for the studio, which ends its runs in order.
    setpgid(0, 0);
    if (talk == kTalkDescriptor) {
        fcntl(talk, F_SETFD, 0);
    } else {
        dup2(talk, kTalkDescriptor);
    }
    keep_from_children(kTalkDescriptor + 1);
    execv(program, arguments);
    _exit(127);
}

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> list;
    for (std::string& word : words) list.push_back(word.data());
    list.push_back(nullptr);
    return list;
}

// The same for a program of the system.
[[noreturn]] void become_quietly(char* const* words, int output) {
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(output >= 0 ? output : nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
    keep_from_children(STDERR_FILENO + 1);
    execvp(words[0], words);
    _exit(127);
}

}  // namespace

// ---- Pipe ----

Pipe::Pipe(int descriptor) : descriptor_(descriptor) {
    fcntl(descriptor_, F_SETFL, fcntl(descriptor_, F_GETFL) | O_NONBLOCK);
}

Pipe::~Pipe() {
    close();
}

Pipe::Pipe(Pipe&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      closed_(other.closed_),
      in_(std::move(other.in_)),
      out_(std::move(other.out_)),
      sent_(other.sent_) {}

Pipe& Pipe::operator=(Pipe&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(closed_, other.closed_);
    std::swap(in_, other.in_);
    std::swap(out_, other.out_);
    std::swap(sent_, other.sent_);
    return *this;
}

void Pipe::close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    closed_ = true;
}

bool Pipe::send(char kind, std::string_view bytes) {
    if (closed_ || out_.size() - sent_ > kPipeUnsentMax) return false;
    const auto size = static_cast<uint32_t>(bytes.size());
    char head[kHeadBytes];
    std::memcpy(head, &size, sizeof size);
    head[4] = kind;
    out_.append(head, kHeadBytes);
    out_.append(bytes);
    flush();
    return true;
}

void Pipe::flush() {
    while (!closed_ && has_unsent()) {
        const ssize_t wrote =
            ::send(descriptor_, out_.data() + sent_, out_.size() - sent_, MSG_NOSIGNAL);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
        if (wrote <= 0) return close();
        sent_ += static_cast<size_t>(wrote);
    }
    if (sent_ == out_.size() || sent_ > kTidyBytes) {
        out_.erase(0, sent_);
        sent_ = 0;
    }
}

void Pipe::read_some() {
    char buffer[kReadBytes];
    while (!closed_ && in_.size() <= kPacketBytesMax) {
        const ssize_t got = ::recv(descriptor_, buffer, sizeof buffer, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
        if (got <= 0) return close();
        in_.append(buffer, static_cast<size_t>(got));
    }
}

std::vector<Packet> Pipe::receive() {
    if (!closed_) read_some();
    std::vector<Packet> packets;
    size_t at = 0;
    while (in_.size() - at >= kHeadBytes) {
        uint32_t size = 0;
        std::memcpy(&size, in_.data() + at, sizeof size);
        if (size > kPacketBytesMax) {
            close();
            break;
        }
        if (in_.size() - at < kHeadBytes + size) break;
        packets.push_back({in_[at + 4], in_.substr(at + kHeadBytes, size)});
        at += kHeadBytes + size;
    }
    in_.erase(0, at);
    return packets;
}

void Pipe::wait(int milliseconds) const {
    pollfd asked{descriptor_, static_cast<short>(has_unsent() ? POLLIN | POLLOUT : POLLIN), 0};
    ::poll(&asked, descriptor_ >= 0 ? 1 : 0, milliseconds);
}

// ---- Child ----

Result<Child> Child::start(const ChildOptions& options) {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0) {
        return system_error("cannot make a socket pair for a run");
    }
    std::vector<std::string> words = {options.name};
    words.insert(words.end(), options.arguments.begin(), options.arguments.end());
    const std::vector<char*> arguments = pointers(words);
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process == 0) {
        become(options.program.c_str(), arguments.data(), pair[1], options.memory_max, parent);
    }
    ::close(pair[1]);
    Pipe pipe(pair[0]);
    if (process < 0) return system_error("cannot start a process for a run");
    return Child(process, std::move(pipe));
}

Child::~Child() {
    if (process_ < 0) return;
    kill();
    waitpid(process_, nullptr, 0);
}

Child::Child(Child&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      end_(std::move(other.end_)),
      pipe_(std::move(other.pipe_)) {}

Child& Child::operator=(Child&& other) noexcept {
    std::swap(process_, other.process_);
    std::swap(end_, other.end_);
    std::swap(pipe_, other.pipe_);
    return *this;
}

std::optional<ChildEnd> Child::ended() {
    if (end_ || process_ < 0) return end_;
    int status = 0;
    const pid_t found = waitpid(process_, &status, WNOHANG);
    // Our parent ignores SIGCHLD, and so do we: then the system keeps no end.
    const bool unseen = found < 0 && errno == ECHILD;
    if (found != process_ && !unseen) return std::nullopt;
    process_ = -1;
    ChildEnd end;
    if (unseen) {
        end.what = "ended; the system does not tell how";
    } else if (WIFSIGNALED(status)) {
        end.signal = WTERMSIG(status);
        end.what = fmt::format("was ended by signal {} ({})", end.signal, strsignal(end.signal));
    } else {
        end.good = WEXITSTATUS(status) == 0;
        end.what = fmt::format("exited with status {}", WEXITSTATUS(status));
    }
    end_ = std::move(end);
    return end_;
}

void Child::kill() {
    if (process_ > 0) ::kill(process_, SIGKILL);
}

// ---- Printing ----

Result<Printing> Printing::start(const std::vector<std::string>& words, size_t most) {
    int pipe[2];
    if (pipe2(pipe, O_CLOEXEC | O_NONBLOCK) != 0) return system_error("cannot make a pipe");
    std::vector<std::string> copy = words;
    const std::vector<char*> arguments = pointers(copy);
    const pid_t process = fork();
    if (process == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        become_quietly(arguments.data(), pipe[1]);
    }
    ::close(pipe[1]);
    if (process < 0) {
        ::close(pipe[0]);
        return system_error("cannot start " + words[0]);
    }
    return Printing(process, pipe[0], most);
}

Printing::~Printing() {
    if (output_ >= 0) ::close(output_);
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

Printing::Printing(Printing&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      output_(std::exchange(other.output_, -1)),
      most_(other.most_),
      good_(other.good_),
      text_(std::move(other.text_)) {}

Printing& Printing::operator=(Printing&& other) noexcept {
    std::swap(process_, other.process_);
    std::swap(output_, other.output_);
    std::swap(most_, other.most_);
    std::swap(good_, other.good_);
    std::swap(text_, other.text_);
    return *this;
}

// Asks for the end first: what it prints until then is there to be read.
bool Printing::read() {
    if (process_ < 0) return true;
    int status = 0;
    const bool ended = waitpid(process_, &status, WNOHANG) == process_;
    if (ended) good_ = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    char buffer[4096];
    while (!is_full()) {
        const size_t room = std::min(sizeof buffer, most_ - text_.size());
        const ssize_t got = ::read(output_, buffer, room);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        text_.append(buffer, static_cast<size_t>(got));
    }
    if (ended) process_ = -1;
    return ended;
}

bool start_beside(const std::vector<std::string>& words) {
    std::vector<std::string> copy = words;
    const std::vector<char*> arguments = pointers(copy);
    int told[2];
    if (pipe2(told, O_CLOEXEC) != 0) return false;
    const pid_t process = fork();
    if (process == 0) {
        // A grandchild belongs to nobody here: it outlives us and leaves no zombie.
        setsid();
        const pid_t beside = fork();
        if (beside != 0) _exit(0);
        ::close(told[0]);
        const int nothing = open("/dev/null", O_RDWR);
        dup2(nothing, STDIN_FILENO);
        dup2(nothing, STDOUT_FILENO);
        dup2(nothing, STDERR_FILENO);
        keep_from_children(STDERR_FILENO + 1);
        execvp(arguments[0], arguments.data());
        (void)!::write(told[1], "x", 1);  // exec failed: the other end hears it
        _exit(127);
    }
    ::close(told[1]);
    if (process > 0) waitpid(process, nullptr, 0);
    char letter = 0;
    const bool failed = process < 0 || ::read(told[0], &letter, 1) == 1;
    ::close(told[0]);
    return !failed;
}

std::string own_program() {
    std::string path(4096, '\0');
    const ssize_t size = readlink("/proc/self/exe", path.data(), path.size());
    path.resize(size > 0 ? static_cast<size_t>(size) : 0);
    return path;
}

std::string host_name() {
    char name[256] = {};
    return gethostname(name, sizeof name - 1) == 0 ? name : "";
}

std::string random_bytes(size_t count) {
    std::string bytes(count, '\0');
    size_t got = 0;
    while (got < count) {
        const ssize_t more = getrandom(bytes.data() + got, count - got, 0);
        if (more > 0) got += static_cast<size_t>(more);
    }
    return bytes;
}

int64_t random_number() {
    int64_t number = 0;
    for (const char byte : random_bytes(6)) number = number * 256 + static_cast<uint8_t>(byte);
    return number;
}

}  // namespace vagus::serve
