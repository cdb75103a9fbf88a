#include "cli/output.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace vagus::cli {

bool print(std::string_view text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    return std::fflush(stdout) == 0 && written;
}

int complain(std::string_view sentence, int exit_code) {
    // One write, so that the lines of several threads do not mix.
    const std::string line = "vagus: " + std::string(sentence) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
    return exit_code;
}

int complain(const Error& error, int exit_code) {
    return complain(error.what, exit_code);
}

bool stdout_is_terminal() {
    return ::isatty(STDOUT_FILENO) == 1;
}

bool stderr_is_terminal() {
    return ::isatty(STDERR_FILENO) == 1;
}

}  // namespace vagus::cli
