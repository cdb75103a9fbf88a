#include "base/log_lines.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <utility>

#include "base/text.hpp"

namespace vagus {

namespace {

// A pipe or terminal, opened a second time: that it never waits is then our affair alone, and not
// that of the shell, whose terminal it is. -1 if it cannot be opened so.
int opened_again(int descriptor) {
    const std::string name = fmt::format("/proc/self/fd/{}", descriptor);
    return ::open(name.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

// The whole lines at its beginning that have room in `room` bytes.
std::string_view lines_that_fit(std::string_view lines, size_t room) {
    if (lines.size() <= room) return lines;
    const size_t end = lines.substr(0, room).rfind('\n');
    return end == lines.npos ? std::string_view{} : lines.substr(0, end + 1);
}

uint64_t lines_in(std::string_view text) {
    return static_cast<uint64_t>(std::ranges::count(text, '\n'));
}

}  // namespace

LogLines::LogLines(int descriptor, Duration patience, Missing missing)
    : descriptor_(descriptor), patience_(patience), missing_(missing) {
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
    (void)finish();
    if (own_) ::close(descriptor_);
}

uint64_t LogLines::finish() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
    return counted_ + left_out_ + (nobody_there_ ? 0 : lines_in(waiting_));
}

bool LogLines::add(std::string_view lines) {
    return add_unescaped(visible_lines(lines));
}

bool LogLines::add_unescaped(std::string_view rest) {
    std::unique_lock lock(mutex_);
    while (!rest.empty() && !nobody_there_) {
        const std::string_view piece = lines_that_fit(rest, kLogBytesMax - waiting_.size());
        // Behind lines that were left out there are none until it is said how many those were.
        if (left_out_ == 0 && !piece.empty()) {
            waiting_ += piece;
            rest.remove_prefix(piece.size());
            posted_.notify_one();
        } else if (left_out_ == 0 && !waited_ && patience_ > Duration{} && !waiting_.empty()) {
            make_room(lock);
        } else {
            left_out_ += lines_in(rest);
            break;
        }
    }
    return !nobody_there_;
}

// Waits until the thread has taken what waits, or patience is over.
void LogLines::make_room(std::unique_lock<std::mutex>& lock) {
    const auto has_room = [this] { return waiting_.empty() || nobody_there_; };
    waited_ = !taken_.wait_for(lock, patience_, has_room);
}

void LogLines::complain(std::string_view sentence) {
    add("vagus: " + std::string(sentence) + "\n");
}

void LogLines::run(const std::stop_token& stop) {
    for (Wrote wrote = Wrote::All; wrote == Wrote::All;) {
        std::string lines;
        {
            std::unique_lock lock(mutex_);
            const auto is_posted = [this] { return !waiting_.empty() || left_out_ > 0; };
            if (!posted_.wait(lock, stop, is_posted)) return;
            lines = take_lines();
        }
        taken_.notify_all();
        std::string_view left = lines;
        wrote = write(left, stop);
        const std::lock_guard lock(mutex_);
        counted_ += lines_in(left);
        if (wrote != Wrote::NobodyIsThere) continue;
        nobody_there_ = true;
        taken_.notify_all();
    }
}

// With the mutex held.
std::string LogLines::take_lines() {
    std::string lines = std::exchange(waiting_, {});
    const uint64_t left_out = std::exchange(left_out_, 0);
    waited_ = false;
    if (missing_ == Missing::Counted) {
        counted_ += left_out;
    } else if (left_out > 0) {
        lines += fmt::format("vagus: {} lines were left out here\n", left_out);
    } else {
        // All of them are there.
    }
    return lines;
}

LogLines::Wrote LogLines::write(std::string_view& bytes, const std::stop_token& stop) const {
    int looks = kLastLooks;
    while (!bytes.empty()) {
        // Where a write could wait, it is small enough for the room that poll() has seen.
        const bool may_wait = !own_ && !socket_;
        if (may_wait && !looks_again(looks, stop)) return Wrote::NobodyTakesIt;
        const size_t size = may_wait ? std::min<size_t>(bytes.size(), PIPE_BUF) : bytes.size();
        const ssize_t wrote =
            socket_ ? ::send(descriptor_, bytes.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL)
                    : ::write(descriptor_, bytes.data(), size);
        if (wrote >= 0) {
            bytes.remove_prefix(static_cast<size_t>(wrote));
            looks = kLastLooks;
        } else if (errno != EINTR) {
            if (errno != EAGAIN) return Wrote::NobodyIsThere;
            if (!looks_again(looks, stop)) return Wrote::NobodyTakesIt;
        }
    }
    return Wrote::All;
}

// Until there is room. False: it is the end, and nobody makes some.
bool LogLines::looks_again(int& looks, const std::stop_token& stop) const {
    for (;;) {
        pollfd room{descriptor_, POLLOUT, 0};
        const bool found = ::poll(&room, 1, kLookMs) > 0;
        if (stop.stop_requested() && looks-- == 0) return false;
        if (found) return true;
    }
}

}  // namespace vagus
