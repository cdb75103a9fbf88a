// Lines on stderr from a process that must not wait for their reader: a terminal that is held
// (Ctrl+S), a pipe that nobody reads, a journal that is frozen. A thread of its own writes them;
// what does not fit is dropped, and it is said how many lines that were.
//
//     LogLines log;
//     log.complain("127.0.0.1: a wrong token");       // returns at once
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

namespace vagus::cli {

constexpr size_t kLogBytesMax = 256u << 10;  // of lines that wait
// What waits at the end has so many chances, of kLookMs each, that somebody takes it.
constexpr int kLastLooks = 10;
constexpr int kLookMs = 50;

class LogLines {
public:
    // The descriptor is borrowed; others may write to it, too.
    explicit LogLines(int descriptor = 2);
    // Writes what waits, as far as somebody takes it.
    ~LogLines();
    LogLines(const LogLines&) = delete;
    LogLines& operator=(const LogLines&) = delete;

    // Whole lines, escaped like those of output.hpp. From any thread.
    void add(std::string_view lines);
    // "vagus: sentence".
    void complain(std::string_view sentence);

private:
    void run(const std::stop_token& stop);
    bool write(std::string_view bytes, const std::stop_token& stop) const;

    int descriptor_;
    bool own_ = false;     // opened here, so that a write never waits
    bool socket_ = false;  // cannot be opened again, and need not be
    std::mutex mutex_;     // guards the next two
    std::string waiting_;
    size_t left_out_ = 0;  // lines
    std::condition_variable_any posted_;
    std::jthread thread_;
};

}  // namespace vagus::cli
