#include "cli/log_lines.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/text.hpp"

namespace vagus::cli {

namespace {

// A pipe or terminal, opened a second time: that it never waits is then our affair alone, and not
// that of the shell, whose terminal it is. -1 if it cannot be opened so.
int opened_again(int descriptor) {
    const std::string name = fmt::format("/proc/self/fd/{}", descriptor);
    return ::open(name.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

}  // namespace

LogLines::LogLines(int descriptor) : descriptor_(descriptor) {
    struct stat file = {};
    if (::fstat(descriptor, &file) == 0) {
        socket_ = S_ISSOCK(file.st_mode);
        const bool waits = S_ISFIFO(file.st_mode) || S_ISCHR(file.st_mode);
        const int again = waits ? opened_again(descriptor) : -1;
        own_ = again >= 0;
        if (own_) descriptor_ = again;
    }
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

LogLines::~LogLines() {
    thread_.request_stop();
    thread_.join();
    if (own_) ::close(descriptor_);
}

void LogLines::add(std::string_view lines) {
    const std::string visible = visible_lines(lines);
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() + visible.size() > kLogBytesMax) {
            left_out_ += static_cast<size_t>(std::count(visible.begin(), visible.end(), '\n'));
            return;
        }
        waiting_ += visible;
    }
    posted_.notify_one();
}

void LogLines::complain(std::string_view sentence) {
    add("vagus: " + std::string(sentence) + "\n");
}

void LogLines::run(const std::stop_token& stop) {
    for (bool taken = true; taken;) {
        std::string lines;
        {
            std::unique_lock lock(mutex_);
            if (!posted_.wait(lock, stop, [this] { return !waiting_.empty(); })) return;
            lines = std::exchange(waiting_, {});
            if (const size_t left_out = std::exchange(left_out_, 0); left_out > 0) {
                lines += fmt::format("vagus: {} lines were left out here\n", left_out);
            }
        }
        taken = write(lines, stop);
    }
}

// False: it is the end, and nobody has taken it. Where nobody is any more, lines are lost.
bool LogLines::write(std::string_view bytes, const std::stop_token& stop) const {
    int looks = kLastLooks;
    while (!bytes.empty()) {
        const ssize_t wrote =
            socket_ ? ::send(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL)
                    : ::write(descriptor_, bytes.data(), bytes.size());
        if (wrote >= 0) {
            bytes.remove_prefix(static_cast<size_t>(wrote));
            continue;
        }
        if (errno == EINTR) continue;
        if (errno != EAGAIN) return true;
        if (stop.stop_requested() && looks-- == 0) return false;
        pollfd ready{descriptor_, POLLOUT, 0};
        ::poll(&ready, 1, kLookMs);
    }
    return true;
}

}  // namespace vagus::cli
