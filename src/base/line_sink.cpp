#include "base/line_sink.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/file.hpp"
#include "base/log_lines.hpp"
#include "base/one_writer.hpp"
#include "base/text.hpp"

namespace vagus {
namespace {

Error failure(const std::string& name) {
    const int reason = errno;
    const Code code = reason == ENOENT ? Code::NotFound : Code::Unavailable;
    return {code, name + ": cannot be written: " + std::strerror(reason)};
}

// How many of the bytes were written; errno says why not all.
size_t write_some(int descriptor, std::string_view bytes) {
    size_t written = 0;
    while (written < bytes.size()) {
        const std::string_view left = bytes.substr(written);
        const ssize_t count = ::write(descriptor, left.data(), left.size());
        if (count >= 0) {
            written += static_cast<size_t>(count);
            continue;
        }
        if (errno == EINTR) continue;
        if (errno != EAGAIN) break;
        pollfd ready{descriptor, POLLOUT, 0};
        ::poll(&ready, 1, -1);
    }
    return written;
}

// Takes back the last `count` bytes of a file, if they are its end. Nothing else can be taken back.
void take_back(int descriptor, size_t count) {
    struct stat file = {};
    if (count == 0 || ::fstat(descriptor, &file) != 0 || !S_ISREG(file.st_mode)) return;
    const off_t end = ::lseek(descriptor, 0, SEEK_CUR);
    const auto back = static_cast<off_t>(count);
    if (end != file.st_size || end < back) return;
    if (::ftruncate(descriptor, end - back) == 0) ::lseek(descriptor, end - back, SEEK_SET);
}

}  // namespace

Result<LineSink> LineSink::open(const std::string& path, When when, std::string_view begins) {
    LineSink sink;
    sink.when_ = when;
    sink.name_ = path == "-" ? "standard output" : path;
    if (path.empty()) return sink;
    if (path == "-") {
        sink.descriptor_ = STDOUT_FILENO;
        sink.terminal_ = ::isatty(STDOUT_FILENO) == 1;
        return sink;
    }
    if (is_file_of_another_kind(path, begins)) {
        return Error{Code::Refused,
                     fmt::format("{}: is there already, and is something else: what "
                                 "is written there begins with {}; name another file",
                                 path, begins)};
    }
    sink.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (sink.descriptor_ < 0) return failure(path);
    TRY(begin_to_write(sink.descriptor_, path));
    sink.terminal_ = ::isatty(sink.descriptor_) == 1;
    return sink;
}

LineSink::LineSink() = default;

LineSink::LineSink(LineSink&& other) noexcept
    : name_(std::move(other.name_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      terminal_(other.terminal_),
      when_(other.when_),
      waiting_(std::exchange(other.waiting_, {})),
      waits_since_(other.waits_since_),
      failure_(std::move(other.failure_)),
      abandoned_(other.abandoned_),
      patience_(other.patience_),
      unwaiting_(std::move(other.unwaiting_)),
      left_out_(other.left_out_) {}

LineSink& LineSink::operator=(LineSink&& other) noexcept {
    LineSink taken(std::move(other));
    std::swap(name_, taken.name_);
    std::swap(descriptor_, taken.descriptor_);
    std::swap(terminal_, taken.terminal_);
    std::swap(when_, taken.when_);
    std::swap(waiting_, taken.waiting_);
    std::swap(waits_since_, taken.waits_since_);
    std::swap(failure_, taken.failure_);
    std::swap(abandoned_, taken.abandoned_);
    std::swap(patience_, taken.patience_);
    std::swap(unwaiting_, taken.unwaiting_);
    std::swap(left_out_, taken.left_out_);
    return *this;
}

LineSink::~LineSink() {
    put();
    unwaiting_.reset();  // it writes to the descriptor
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
}

void LineSink::never_wait(Duration patience) {
    struct stat file = {};
    const bool may_wait = descriptor_ >= 0 && ::fstat(descriptor_, &file) == 0 &&
                          (S_ISFIFO(file.st_mode) || S_ISSOCK(file.st_mode) || terminal_);
    if (may_wait) patience_ = patience;
}

void LineSink::write(std::string_view lines) {
    if (descriptor_ < 0 || failure_ || abandoned_) return;
    waiting_ += terminal_ ? visible_lines(lines) : std::string(lines);
    if (when_ == When::AtOnce || waiting_.size() >= kLinesWaitMax) put();
}

void LineSink::pass(Time now) {
    if (waiting_.empty()) {
        waits_since_.reset();
    } else if (!waits_since_) {
        waits_since_ = now;
    } else if (now - *waits_since_ >= kLinesWaitFor) {
        put();
    } else {
        // It has not waited long enough.
    }
}

void LineSink::put() {
    const std::string lines = std::exchange(waiting_, {});
    waits_since_.reset();
    if (lines.empty() || descriptor_ < 0 || failure_ || abandoned_) return;
    if (patience_) return put_unwaiting(lines);
    const size_t written = write_some(descriptor_, lines);
    if (written < lines.size()) fail(std::string_view(lines).substr(0, written));
}

void LineSink::put_unwaiting(std::string_view lines) {
    if (!unwaiting_) {
        unwaiting_ =
            std::make_unique<LogLines>(descriptor_, *patience_, LogLines::Missing::Counted);
    }
    if (unwaiting_->add_unescaped(lines)) return;
    errno = EPIPE;
    fail({});
}

void LineSink::fail(std::string_view begun) {
    if (errno == EPIPE && descriptor_ == STDOUT_FILENO) {
        abandoned_ = true;
        return;
    }
    failure_ = failure(name_);
    const size_t newline = begun.rfind('\n');
    take_back(descriptor_, newline == begun.npos ? begun.size() : begun.size() - newline - 1);
}

Status LineSink::flush() {
    put();
    if (unwaiting_) left_out_ += unwaiting_->finish();
    unwaiting_.reset();
    if (failure_ || abandoned_ || left_out_ == 0) return state();
    return Error{Code::Limit, fmt::format("{}: nobody read it in time; {} lines were left out",
                                          name_, left_out_)};
}

Status LineSink::state() const {
    return failure_ ? Status(*failure_) : Status::done();
}

void write_to_stderr(std::string_view lines) {
    write_some(STDERR_FILENO, visible_lines(lines));
}

void prepare_standard_files() {
    for (const int signal_number : {SIGPIPE, SIGXFSZ}) {
        struct sigaction ignored = {};
        ignored.sa_handler = SIG_IGN;
        ::sigaction(signal_number, &ignored, nullptr);
    }
    // The lowest free number is given next: it is the closed one. Opened for the wrong direction,
    // it fails as the closed one would.
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(standard, F_GETFD) >= 0) continue;
        const int flags = standard == STDIN_FILENO ? O_WRONLY : O_RDONLY;
        [[maybe_unused]] const int held = ::open("/dev/null", flags);
    }
}

}  // namespace vagus
