// What a verb says: results on stdout, words for people on stderr. Every piece is written at once,
// so that a program that reads along sees each line when it is made.
#pragma once

#include <string_view>

#include "base/result.hpp"

namespace vagus::cli {

constexpr int kExitDone = 0;
constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

// Writes to stdout. False once nobody reads there any more (`vagus … | head -1`): a verb that runs
// on ends then, with exit code 0. SIGPIPE never ends the process (main.cpp).
bool print(std::string_view text);

// The last word of the program: `exit_code`, but kExitFailed with a sentence if some of the output
// was lost although there is a reader (a full disk).
int end_output(int exit_code);

// "vagus: sentence" on stderr, with a final newline. Gives `exit_code`, so that a verb can `return
// complain(…)`.
int complain(std::string_view sentence, int exit_code = kExitFailed);
int complain(const Error& error, int exit_code = kExitFailed);

// Is a person looking?
bool stdout_is_terminal();
bool stderr_is_terminal();

}  // namespace vagus::cli
