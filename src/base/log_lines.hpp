// Lines on stderr or stdout from a process that must not wait for their reader: a terminal that is
// held (Ctrl+S), a pipe that nobody reads, a journal that is frozen. A thread of its own writes
// them; what does not fit is left out, and it is said there how many lines that were.
//
//     LogLines log;
//     log.complain("127.0.0.1: a wrong token");       // returns at once
//
// Where a program reads the lines (a trace), a sentence between them would be one that it cannot
// read: there they are counted instead (Missing::Counted).
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "base/time.hpp"

namespace vagus {

constexpr size_t kLogBytesMax = 256u << 10;  // of lines that wait
// What waits at the end has so many chances, of kLookMs each, that somebody takes it.
constexpr int kLastLooks = 10;
constexpr int kLookMs = 50;

class LogLines {
public:
    // What becomes of the number of lines that were left out.
    enum class Missing : uint8_t { Said, Counted };

    // The descriptor is borrowed; others may write to it, too. Where lines do not fit, a reader
    // that reads has so much `patience` to make room; one that does not read is waited for once.
    explicit LogLines(int descriptor = 2, Duration patience = {}, Missing missing = Missing::Said);
    // Writes what waits, as far as somebody takes it.
    ~LogLines();
    LogLines(const LogLines&) = delete;
    LogLines& operator=(const LogLines&) = delete;

    // Whole lines, escaped like those of output.hpp. From any thread. False once the reader
    // is gone.
    bool add(std::string_view lines);
    // The same, byte for byte.
    bool add_unescaped(std::string_view lines);
    // "vagus: sentence".
    void complain(std::string_view sentence);
    // Writes what waits, as far as somebody takes it, and nothing from then on. How many lines were
    // left out, if those are counted.
    uint64_t finish();

private:
    enum class Wrote : uint8_t { All, NobodyTakesIt, NobodyIsThere };

    void run(const std::stop_token& stop);
    void make_room(std::unique_lock<std::mutex>& lock);
    Wrote write(std::string_view& bytes, const std::stop_token& stop) const;
    std::string take_lines();
    bool looks_again(int& looks, const std::stop_token& stop) const;

    int descriptor_;
    bool own_ = false;     // opened here, so that a write never waits
    bool socket_ = false;  // cannot be opened again, and need not be
    Duration patience_;
    Missing missing_;
    std::mutex mutex_;  // guards all below but the thread
    std::string waiting_;
    uint64_t left_out_ = 0;  // lines, since the thread has last taken some
    uint64_t counted_ = 0;   // those before, and those that nobody took at the end
    bool waited_ = false;    // in vain, since lines were last taken
    bool nobody_there_ = false;
    std::condition_variable_any posted_;
    std::condition_variable taken_;
    std::jthread thread_;
};

}  // namespace vagus
