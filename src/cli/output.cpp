#include "cli/output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

namespace vagus::cli {

bool print(std::string_view text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (std::fflush(stdout) == 0 && written) return true;
    if (errno == EPIPE) std::clearerr(stdout);  // the reader has seen enough: not a failure
    return false;
}

int end_output(int exit_code) {
    if (std::ferror(stdout) == 0) return exit_code;
    return complain("the output could not be written to its end; is the disk full?");
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
