#include "cli/emulate/keep.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/file.hpp"
#include "base/text.hpp"

namespace vagus::cli {

namespace {

// What the firmware says when all is in its memory (firmware/node/firmware.cpp).
constexpr std::string_view kSaved = "Flashing OK";
constexpr uint32_t kBytesOfPacket = 1024;  // QEMU takes packets of 4096 letters
constexpr size_t kPieceBytes = 4096;
constexpr timeval kAnswerWithin = {.tv_sec = 10, .tv_usec = 0};  // a busy machine is slow
constexpr int kLookAgain_ms = 100;
constexpr char kInterrupt = '\x03';

Error monitor_lost(const std::string& why) {
    return {Code::Unavailable, "QEMU cannot be asked for the memory of the board: " + why};
}

// Empty if it is not hex.
std::string bytes_of(std::string_view hex) {
    std::string bytes;
    const auto digit = [](char letter) {
        return std::string_view("0123456789abcdef").find(letter);
    };
    for (size_t i = 0; i + 1 < hex.size(); i += 2) {
        const size_t high = digit(hex[i]), low = digit(hex[i + 1]);
        if (high > 15 || low > 15) return "";
        bytes += static_cast<char>(high << 4 | low);
    }
    return bytes;
}

void close_once(int& descriptor) {
    if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

}  // namespace

Result<std::string> kept_bytes(const KeptMemory& memory) {
    struct stat there {};
    if (::stat(memory.file.c_str(), &there) != 0 && errno == ENOENT) return std::string();
    std::string bytes = TRY(read_file(memory.file));
    if (bytes.size() == memory.bytes) return bytes;
    return Error{Code::BadInput,
                 fmt::format("{}: expected the {} bytes that the board keeps, found {}; delete the "
                             "file to begin with a board that has saved nothing",
                             memory.file, memory.bytes, bytes.size())};
}

size_t WordFinder::before_the_end(std::string_view bytes) {
    std::string all = last_;
    all += bytes;
    const size_t found = all.find(word_);
    const size_t seen = last_.size();
    if (found == std::string::npos) {
        last_ = all.substr(all.size() - std::min(all.size(), word_.size() - 1));
        return bytes.size();
    }
    last_.clear();
    return found + word_.size() - 1 - seen;
}

// ---- the line for debuggers: $packet#checksum, each confirmed by + ----

BoardMonitor::~BoardMonitor() {
    close_once(descriptor_);
}

Status BoardMonitor::send(std::string_view packet) {
    uint8_t sum = 0;
    for (const char letter : packet) sum = static_cast<uint8_t>(sum + static_cast<uint8_t>(letter));
    const std::string text = fmt::format("${}#{:02x}", packet, sum);
    const ssize_t sent = ::send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(text.size())) return Status::done();
    return monitor_lost(std::strerror(errno));
}

Result<std::string> BoardMonitor::answer() {
    for (;;) {
        const size_t begin = bytes_.find('$');
        const size_t end = bytes_.find('#', std::min(begin, bytes_.size()));
        if (end != std::string::npos && bytes_.size() >= end + 3) {
            std::string packet = bytes_.substr(begin + 1, end - begin - 1);
            bytes_.erase(0, end + 3);
            (void)!::send(descriptor_, "+", 1, MSG_NOSIGNAL);
            return packet;
        }
        std::array<char, kPieceBytes> piece;
        const ssize_t got = ::recv(descriptor_, piece.data(), piece.size(), 0);
        if (got < 0 && errno == EINTR) continue;
        if (got == 0) return monitor_lost("it has ended");
        if (got < 0) return monitor_lost("no answer");
        bytes_.append(piece.data(), static_cast<size_t>(got));
    }
}

Result<std::string> BoardMonitor::ask(std::string_view packet) {
    TRY(send(packet));
    return answer();
}

Status BoardMonitor::write(uint32_t at, std::string_view bytes) {
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &kAnswerWithin, sizeof kAnswerWithin);
    for (size_t done = 0; done < bytes.size(); done += kBytesOfPacket) {
        const std::string_view piece = bytes.substr(done, kBytesOfPacket);
        const std::string said =
            TRY(ask(fmt::format("M{:x},{:x}:{}", at + done, piece.size(), hex_of(piece))));
        if (said != "OK") return monitor_lost("it refuses to write, " + said);
    }
    return Status::done();
}

Result<std::string> BoardMonitor::read(uint32_t at, uint32_t bytes) {
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &kAnswerWithin, sizeof kAnswerWithin);
    std::string all;
    while (all.size() < bytes) {
        const size_t count = std::min<size_t>(kBytesOfPacket, bytes - all.size());
        const std::string piece =
            bytes_of(TRY(ask(fmt::format("m{:x},{:x}", at + all.size(), count))));
        if (piece.size() != count) return monitor_lost("it refuses to read");
        all += piece;
    }
    return all;
}

Status BoardMonitor::pause() {
    if (::send(descriptor_, &kInterrupt, 1, MSG_NOSIGNAL) != 1) {
        return monitor_lost(std::strerror(errno));
    }
    (void)TRY(answer());  // why it is paused
    return Status::done();
}

Status BoardMonitor::resume() {
    return send("c");
}

// ---- between board and switch ----

MemoryKeeper::MemoryKeeper(std::string name, KeptMemory memory, int board, int monitor)
    : name_(std::move(name)),
      memory_(std::move(memory)),
      monitor_(monitor),
      board_(board),
      saved_(kSaved) {}

MemoryKeeper::~MemoryKeeper() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
    close_once(line_);
    close_once(board_);
}

Status MemoryKeeper::begin() {
    const std::string bytes = TRY(kept_bytes(memory_));
    TRY(monitor_.write(memory_.at, bytes));
    TRY(monitor_.resume());
    int line[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line) != 0) {
        return Error{Code::Unavailable, name_ + ": cannot make a line: " + std::strerror(errno)};
    }
    line_ = line[0];
    thread_ = std::jthread([this, own = line[1]] { pass_on(own); });
    return Status::done();
}

int MemoryKeeper::take_line() {
    return std::exchange(line_, -1);
}

const std::string& MemoryKeeper::trouble() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
    return trouble_;
}

// Until one side is closed, or the memory cannot be kept. A side is read only when what came from
// it before is written, so no more than one piece waits.
void MemoryKeeper::pass_on(int own) {
    Way to_switch{.from = board_, .to = own};
    Way to_board{.from = own, .to = board_};
    bool open = true;
    while (open && !ended_) {
        const auto wanted = [](const Way& reads, const Way& writes) {
            return static_cast<short>((reads.waiting.empty() ? POLLIN : 0) |
                                      (writes.waiting.empty() ? 0 : POLLOUT));
        };
        pollfd sides[2] = {{board_, wanted(to_switch, to_board), 0},
                           {own, wanted(to_board, to_switch), 0}};
        ::poll(sides, 2, kLookAgain_ms);
        open = move(to_switch) && move(to_board);
    }
    ::close(own);
}

// False: it is closed.
bool MemoryKeeper::move(Way& way) {
    if (!way.waiting.empty()) return write(way, way.waiting.size());
    std::array<char, kPieceBytes> piece;
    const ssize_t got = ::recv(way.from, piece.data(), piece.size(), MSG_DONTWAIT);
    if (got < 0) return errno == EAGAIN || errno == EINTR;
    if (got == 0) return false;
    way.waiting.assign(piece.data(), static_cast<size_t>(got));
    if (way.from != board_) return write(way, way.waiting.size());
    // Each time that the word ends in this piece, the memory is kept before its last byte goes on.
    for (std::string_view rest = way.waiting; !rest.empty();) {
        const size_t before = saved_.before_the_end(rest);
        if (before == rest.size()) break;
        const Status kept = keep();
        if (!kept.ok()) {
            trouble_ = name_ + ": what it saved cannot be kept: " + kept.error().what;
            return false;
        }
        rest.remove_prefix(before + 1);
    }
    return write(way, way.waiting.size());
}

bool MemoryKeeper::write(Way& way, size_t count) const {
    const ssize_t written = ::send(way.to, way.waiting.data(), count, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (written < 0) return errno == EAGAIN || errno == EINTR;
    way.waiting.erase(0, static_cast<size_t>(written));
    return true;
}

Status MemoryKeeper::keep() {
    TRY(monitor_.pause());
    const auto bytes = monitor_.read(memory_.at, memory_.bytes);
    TRY(monitor_.resume());
    if (!bytes.ok()) return bytes.error();
    return write_file(memory_.file, bytes.value());
}

}  // namespace vagus::cli
