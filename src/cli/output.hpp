// What a verb says: results on stdout, words for people on stderr. Every piece is written at once,
// so that a program that reads along sees each line when it is made.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/result.hpp"
#include "base/time.hpp"

namespace vagus::cli {

constexpr int kExitDone = 0;
constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

// Lines for people and JSON on stdout; what a terminal would obey (names from anywhere may hold it)
// is escaped (visible_lines). False once nobody reads there any more (`vagus … | head -1`), or the
// disk is full: a verb that runs on ends then. SIGPIPE never ends the process: see
// prepare_standard_files().
bool print(std::string_view text);

// The content of a file on stdout, byte for byte; only on a terminal as print().
bool print_file(std::string_view content);

// The last word of the program: `exit_code`, but kExitFailed with a sentence if some of the output
// was lost although there is a reader (a full disk).
int end_output(int exit_code);

// Whole lines on stderr, escaped like those of print().
void say(std::string_view lines);

// "vagus: sentence" on stderr, with a final newline. Gives `exit_code`, so that a verb can `return
// complain(…)`.
int complain(std::string_view sentence, int exit_code = kExitFailed);
int complain(const Error& error, int exit_code = kExitFailed);

// That the disk was too slow for a recording: how many samples of what were left out. Says nothing
// for 0.
void complain_left_out(std::string_view file, uint64_t samples, std::string_view of);

// While it lives, print(), say() and complain() never wait for a reader, for a verb that others
// rely on meanwhile: a bus, a robot, a node that is examined. Lines that nobody takes in time are
// left out, and counted where they are missing (base/log_lines.hpp). Files are written as always:
// they keep every line. At its end, what waits is written as far as somebody reads.
//
//     const OutputNeverWaits never;
class OutputNeverWaits {
public:
    // At most one at a time. `patience`: of LogLines.
    explicit OutputNeverWaits(Duration patience = {});
    ~OutputNeverWaits();
    OutputNeverWaits(const OutputNeverWaits&) = delete;
    OutputNeverWaits& operator=(const OutputNeverWaits&) = delete;
};

// Is a person looking?
bool stdout_is_terminal();
bool stderr_is_terminal();

}  // namespace vagus::cli
