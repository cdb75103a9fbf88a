// Where lines go that are made one after the other: traces, logs, listings. A file, stdout or
// nowhere. Whatever goes wrong (a full disk, a closed pipe), what is in the file is whole
// lines, and the first failure is kept for the one who opened the sink.
//
//     LineSink trace = TRY(LineSink::open("run.jsonl", LineSink::When::WithinASecond));
//     trace.write("{\"t\":0.000000}\n");
//     trace.pass(now);                                   // as often as there is time to look
//     const Status written = trace.flush();              // "run.jsonl: cannot be written: …"
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "base/time.hpp"

namespace vagus {

class LogLines;

constexpr size_t kLinesWaitMax = 64u << 10;  // bytes that wait before they are written
constexpr Duration kLinesWaitFor = std::chrono::milliseconds(500);  // with When::WithinASecond

class LineSink {
public:
    enum class When {
        AtOnce,         // each write has left the process when it returns
        WithinASecond,  // pass() writes what has waited for kLinesWaitFor
    };

    LineSink();  // nowhere
    // A new file (what was in it is gone), "-" for stdout, nowhere for an empty path. The Error
    // names the file and the system's reason. On a terminal lines are escaped (visible_lines).
    // `begins`: how such files begin. One that begins otherwise is refused: it is no older one, but
    // a plan, a script, whose name was typed in the wrong place.
    static Result<LineSink> open(const std::string& path, When when, std::string_view begins = {});
    // Writes what waits.
    ~LineSink();
    LineSink(LineSink&& other) noexcept;
    LineSink& operator=(LineSink&& other) noexcept;

    // It goes somewhere.
    explicit operator bool() const { return descriptor_ >= 0; }
    // From now on, writes do not wait for the reader of a pipe, a terminal or a socket: lines that
    // are not read in time are left out, and flush() tells how many. `patience`: as in LogLines.
    // Files are written as before and keep every line.
    void never_wait(Duration patience = {});
    // Whole lines, each with its newline. Without effect after a failure.
    void write(std::string_view lines);
    // Told the time, from any clock that only goes forward.
    void pass(Time now);
    // Writes what waits. The first failure since it was opened, then what was left out, else done.
    Status flush();
    // The first failure so far, or done.
    Status state() const;
    // Stdout only: its reader has seen enough and left (`vagus … | head -1`). That is no failure.
    bool abandoned() const { return abandoned_; }

private:
    void put();
    void put_unwaiting(std::string_view lines);
    void fail(std::string_view begun);

    std::string name_;  // for sentences
    int descriptor_ = -1;
    bool terminal_ = false;
    When when_ = When::AtOnce;
    std::string waiting_;
    std::optional<Time> waits_since_;
    std::optional<Error> failure_;
    bool abandoned_ = false;
    std::optional<Duration> patience_;     // nothing: it waits
    std::unique_ptr<LogLines> unwaiting_;  // from the first line on that may not wait
    uint64_t left_out_ = 0;                // lines
};

// Whole lines on stderr, in one write, escaped (visible_lines). Lost if nobody takes them.
void write_to_stderr(std::string_view lines);

// For main(): a reader that leaves and a file that may not grow become failures of a write instead
// of ending the process; and a standard file that the caller closed stays closed to us, so that no
// other file is opened in its place.
void prepare_standard_files();

}  // namespace vagus
