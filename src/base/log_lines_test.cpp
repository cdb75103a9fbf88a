#include "base/log_lines.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <regex>
#include <string>
#include <thread>
#include <utility>

#include "base/line_sink.hpp"

namespace vagus {
namespace {

// Two ends; the writing one waits, as a terminal or a shell's pipe does.
struct Ends {
    int read = -1, write = -1;
    ~Ends() {
        close(read);
        close(write);
    }
    // Nobody reads, and no byte more fits.
    size_t fill() const {
        fcntl(write, F_SETFL, O_NONBLOCK);
        const std::string filler(4096, '-');
        size_t filled = 0;
        for (const size_t piece : {filler.size(), size_t{1}}) {
            for (ssize_t wrote = 1; wrote > 0;) {
                wrote = ::write(write, filler.data(), piece);
                if (wrote > 0) filled += static_cast<size_t>(wrote);
            }
        }
        fcntl(write, F_SETFL, 0);
        return filled;
    }
    std::string take(size_t most) const {
        std::string bytes(most, '\0');
        const ssize_t count = ::read(read, bytes.data(), most);
        bytes.resize(count > 0 ? static_cast<size_t>(count) : 0);
        return bytes;
    }
    // Without its end; waits for it.
    std::string take_line() {
        while (text.find('\n') == std::string::npos) {
            const std::string more = take(1u << 16);
            if (more.empty()) break;
            text += more;
        }
        const std::string line = text.substr(0, text.find('\n'));
        text.erase(0, line.size() + 1);
        return line;
    }
    std::string text = {};
};

std::unique_ptr<Ends> pipe_ends() {
    int both[2];
    EXPECT_EQ(pipe(both), 0);
    return std::unique_ptr<Ends>(new Ends{both[0], both[1]});
}

// As a service manager gives them to its services.
std::unique_ptr<Ends> socket_ends() {
    int both[2];
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, both), 0);
    return std::unique_ptr<Ends>(new Ends{both[0], both[1]});
}

TEST(LogLines, LinesComeInTheirOrderAndEscaped) {
    const auto ends = pipe_ends();
    LogLines log(ends->write);
    log.complain("one");
    log.add("two\x1b[2J\n");
    EXPECT_EQ(ends->take_line(), "vagus: one");
    EXPECT_EQ(ends->take_line(), "two\\u001b[2J");
}

TEST(LogLines, WhoAddsNeverWaitsAndNoLineIsLostUncounted) {
    for (const auto& ends : {pipe_ends(), socket_ends()}) {
        size_t filled = ends->fill();
        LogLines log(ends->write);
        constexpr size_t kLines = 4 * kLogBytesMax / 64;
        for (size_t i = 0; i < kLines; ++i) log.add(std::string(63, 'x') + "\n");
        while (filled > 0) filled -= ends->take(filled).size();
        size_t known = 0, left_out = 0;
        while (known < kLines) {
            const std::string line = ends->take_line();
            if (line == std::string(63, 'x')) {
                ++known;
                continue;
            }
            std::smatch found;
            ASSERT_TRUE(
                std::regex_match(line, found, std::regex("vagus: (\\d+) lines were left out here")))
                << line;
            left_out += std::stoul(found[1]);
            known += std::stoul(found[1]);
        }
        EXPECT_EQ(known, kLines);
        EXPECT_GT(left_out, 0u);
    }
}

TEST(LogLines, WhereAProgramReadsMissingLinesAreCountedInstead) {
    const auto ends = pipe_ends();
    constexpr auto kCounted = LogLines::Missing::Counted;
    LogLines read(ends->write, {}, kCounted);
    read.add_unescaped("a\x1b\nb\n");
    EXPECT_EQ(read.finish(), 0u);
    EXPECT_EQ(ends->take_line(), "a\x1b");
    EXPECT_EQ(ends->take_line(), "b");
    // One batch may be with the thread, another one waits, and the rest finds no room.
    ends->fill();
    LogLines unread(ends->write, {}, kCounted);
    constexpr size_t kLines = 4 * kLogBytesMax / 64;
    for (size_t i = 0; i < kLines; ++i) unread.add_unescaped(std::string(63, 'x') + "\n");
    EXPECT_EQ(unread.finish(), kLines);
}

TEST(LogLines, WithPatienceAReaderGetsEveryLine) {
    const auto ends = pipe_ends();
    constexpr size_t kLines = 8 * kLogBytesMax / 64;
    size_t bytes = 0;
    std::jthread reader([&] {
        while (bytes < kLines * 64) bytes += ends->take(512).size();
    });
    LogLines log(ends->write, std::chrono::hours(1));
    for (size_t i = 0; i < kLines; ++i) log.add(std::string(63, 'x') + "\n");
    reader.join();
    EXPECT_EQ(bytes, kLines * 64);
}

TEST(LogLines, OneThatDoesNotReadIsWaitedForOnce) {
    const auto ends = pipe_ends();
    size_t filled = ends->fill();
    LogLines log(ends->write, std::chrono::milliseconds(1));
    // The first batch is with the thread, the second waits, the third is left out with its rest.
    const std::string lines(kLogBytesMax / 64 * 64, '\n');
    for (int i = 0; i < 3; ++i) log.add(lines);
    log.add("late\n");
    while (filled > 0) filled -= ends->take(filled).size();
    std::string line;
    while ((line = ends->take_line()).empty()) continue;
    EXPECT_TRUE(std::regex_match(line, std::regex("vagus: \\d+ lines were left out here"))) << line;
}

TEST(LogLines, WhoAddsLearnsThatTheReaderIsGone) {
    prepare_standard_files();  // as main() does
    for (const auto& ends : {pipe_ends(), socket_ends()}) {
        close(std::exchange(ends->read, -1));
        LogLines log(ends->write);
        while (log.add("is anybody there?\n")) continue;
    }
}

TEST(LogLines, ItEndsWithoutAReader) {
    prepare_standard_files();  // as main() does
    for (const auto& ends : {pipe_ends(), socket_ends()}) {
        ends->fill();
        LogLines log(ends->write);
        log.complain("nobody will read this");
    }
    // Nor with one that is gone.
    const auto ends = pipe_ends();
    close(std::exchange(ends->read, -1));
    LogLines log(ends->write);
    log.complain("nor this");
}

}  // namespace
}  // namespace vagus
