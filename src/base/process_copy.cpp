#include "base/process_copy.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#if !defined(__has_feature)
#define __has_feature(which) 0
#endif
#if defined(__SANITIZE_THREAD__) || __has_feature(thread_sanitizer)
#define VAGUS_THREADS_ARE_WATCHED 1
#else
#define VAGUS_THREADS_ARE_WATCHED 0
#endif
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
#define VAGUS_ADDRESSES_ARE_WATCHED 1
#else
#define VAGUS_ADDRESSES_ARE_WATCHED 0
#endif

namespace vagus {

namespace {

constexpr int kParentEnded = SIGUSR1;
constexpr int kDescriptorsSearched = 4096;  // where the kernel cannot close a range
// What a sanitizer finds in a copy is to be read. That for threads has one of its own.
constexpr bool kCopySpeaks = VAGUS_ADDRESSES_ARE_WATCHED + VAGUS_THREADS_ARE_WATCHED > 0;
constexpr size_t kThreadsOfSanitizer = VAGUS_THREADS_ARE_WATCHED;

// What the handler reads: set once in a copy, before the signal can come.
volatile sig_atomic_t g_supervisor = 0;

// Whoever made this copy has ended: the supervisor has adopted it, or was it and is gone.
void on_parent_ended(int) {
    if (getppid() != g_supervisor) _exit(0);
}

void ignore(int signal_number) {
    struct sigaction action = {};
    action.sa_handler = SIG_IGN;
    ::sigaction(signal_number, &action, nullptr);
}

// From here on the end of whoever made it is told, however often that changes.
void end_with_supervisor(pid_t parent) {
    struct sigaction action = {};
    action.sa_handler = on_parent_ended;
    action.sa_flags = SA_RESTART;
    ::sigaction(kParentEnded, &action, nullptr);
    sigset_t set;
    ::sigemptyset(&set);
    ::sigaddset(&set, kParentEnded);
    ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
    prctl(PR_SET_PDEATHSIG, kParentEnded);
    const pid_t now = getppid();  // it may have ended before the line above
    if (now != parent && now != g_supervisor) _exit(0);
}

void close_from(unsigned first, unsigned last) {
    if (first > last || close_range(first, last, 0) == 0) return;
    for (unsigned one = first; one <= last && one < kDescriptorsSearched; ++one) {
        ::close(static_cast<int>(one));
    }
}

void close_all_but(int kept) {
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    if (!kCopySpeaks) dup2(nothing, STDERR_FILENO);
    const auto link = static_cast<unsigned>(kept);
    close_from(STDERR_FILENO + 1, link - 1);
    close_from(link + 1, ~0u);
}

// The head of a message, as it travels; the text follows.
struct Head {
    uint32_t word = 0;
    uint32_t size = 0;
    int64_t number = 0;
};

// The descriptor goes with the first byte.
bool send_bytes(int socket, const char* bytes, size_t size, int handed) {
    while (size > 0) {
        iovec part{const_cast<char*>(bytes), size};
        msghdr message = {};
        message.msg_iov = &part;
        message.msg_iovlen = 1;
        alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control = {};
        if (handed >= 0) {
            message.msg_control = control.data();
            message.msg_controllen = control.size();
            cmsghdr* const rights = CMSG_FIRSTHDR(&message);
            rights->cmsg_level = SOL_SOCKET;
            rights->cmsg_type = SCM_RIGHTS;
            rights->cmsg_len = CMSG_LEN(sizeof handed);
            std::memcpy(CMSG_DATA(rights), &handed, sizeof handed);
        }
        const ssize_t sent = ::sendmsg(socket, &message, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        handed = -1;
        bytes += sent;
        size -= static_cast<size_t>(sent);
    }
    return true;
}

bool receive_bytes(int socket, char* bytes, size_t size, int* handed) {
    while (size > 0) {
        iovec part{bytes, size};
        msghdr message = {};
        message.msg_iov = &part;
        message.msg_iovlen = 1;
        alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control = {};
        message.msg_control = control.data();
        message.msg_controllen = control.size();
        const ssize_t got = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        const cmsghdr* const rights = CMSG_FIRSTHDR(&message);
        if (rights != nullptr && rights->cmsg_type == SCM_RIGHTS && handed != nullptr) {
            std::memcpy(handed, CMSG_DATA(rights), sizeof *handed);
        }
        bytes += got;
        size -= static_cast<size_t>(got);
    }
    return true;
}

}  // namespace

std::string system_sentence() {
    return std::strerror(errno);
}

// ---- CopyLink ----

Descriptor::~Descriptor() {
    if (number_ >= 0) ::close(number_);
}

Result<std::pair<CopyLink, CopyLink>> CopyLink::make() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
        return Error{Code::Unavailable,
                     "no socket pair for a copy of the process: " + system_sentence()};
    }
    // A copy has other things in the places of the first three.
    for (int& end : ends) {
        if (end > STDERR_FILENO) continue;
        const int moved = fcntl(end, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        ::close(end);
        end = moved;
    }
    return std::pair(CopyLink(Descriptor(ends[0])), CopyLink(Descriptor(ends[1])));
}

bool CopyLink::send(const CopyMessage& message) const {
    if (message.text.size() > kCopyTextMax) return false;
    const int socket = descriptor_.number();
    const Head head{message.word, static_cast<uint32_t>(message.text.size()), message.number};
    const auto* const bytes = reinterpret_cast<const char*>(&head);
    return send_bytes(socket, bytes, sizeof head, message.handed.number()) &&
           send_bytes(socket, message.text.data(), message.text.size(), -1);
}

std::optional<CopyMessage> CopyLink::receive() const {
    const int socket = descriptor_.number();
    Head head;
    int handed = -1;
    const bool has_head =
        receive_bytes(socket, reinterpret_cast<char*>(&head), sizeof head, &handed);
    CopyMessage message{
        .word = head.word, .number = head.number, .text = {}, .handed = Descriptor(handed)};
    if (!has_head || head.size > kCopyTextMax) return std::nullopt;
    message.text.resize(head.size);
    if (!receive_bytes(socket, message.text.data(), head.size, nullptr)) return std::nullopt;
    return message;
}

// ---- CopyProcess ----

CopyProcess& CopyProcess::operator=(CopyProcess&& other) noexcept {
    std::swap(number_, other.number_);
    std::swap(handle_, other.handle_);
    return *this;
}

void CopyProcess::kill() const {
    if (!handle_.is_open()) return;
    (void)syscall(SYS_pidfd_send_signal, handle_.number(), SIGKILL, nullptr, 0);
}

void CopyProcess::end() {
    kill();
    const Descriptor held = std::move(handle_);
    if (!held.is_open()) return;
    pollfd ends{held.number(), POLLIN, 0};
    while (poll(&ends, 1, -1) < 0 && errno == EINTR) {
    }
    // One that a copy has made is reaped there, by the system.
    siginfo_t how;
    (void)waitid(P_PIDFD, static_cast<id_t>(held.number()), &how, WEXITED);
}

int64_t own_number() {
    return getpid();
}

Descriptor handle_of(int64_t number) {
    return Descriptor(static_cast<int>(syscall(SYS_pidfd_open, static_cast<pid_t>(number), 0)));
}

Descriptor own_handle() {
    return handle_of(own_number());
}

// ---- copies ----

Supervision::Supervision() {
    prctl(PR_GET_CHILD_SUBREAPER, &adopted_before_);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
}

Supervision::~Supervision() {
    prctl(PR_SET_CHILD_SUBREAPER, adopted_before_);
}

int64_t Supervision::copy(const Descriptor& link) const {
    const pid_t supervisor = getpid();
    const pid_t process = fork();
    if (process != 0) return process;
    g_supervisor = supervisor;
    end_with_supervisor(supervisor);
    ignore(SIGINT);  // of a terminal: it is for the supervisor, with which this ends
    ignore(SIGHUP);
    ignore(SIGPIPE);
    ignore(SIGCHLD);  // the system reaps copies of this one
    struct sigaction usual = {};
    usual.sa_handler = SIG_DFL;
    ::sigaction(SIGTERM, &usual, nullptr);
    close_all_but(link.number());
    return 0;
}

int64_t copy_again(const Descriptor& link) {
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process != 0) return process;
    end_with_supervisor(parent);
    close_all_but(link.number());
    return 0;
}

void end_copy() {
    _exit(0);
}

size_t threads_of_process() {
    size_t count = 0;
    std::error_code failed;
    const std::filesystem::directory_iterator all("/proc/self/task", failed);
    if (failed) return 1;
    for ([[maybe_unused]] const auto& one : all) ++count;
    return count > kThreadsOfSanitizer ? count - kThreadsOfSanitizer : count;
}

int64_t copy_of_process() {
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process != 0) return process;
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // it died in between
    return 0;
}

}  // namespace vagus
