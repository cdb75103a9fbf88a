#include "cli/output.hpp"

#include <unistd.h>

#include <mutex>
#include <string>
#include <utility>

#include "base/line_sink.hpp"
#include "base/text.hpp"

namespace vagus::cli {

namespace {

// The process has one stdout, and one memory of what became of it.
LineSink& standard_output() {
    static LineSink sink = std::move(LineSink::open("-", LineSink::When::AtOnce).value());
    return sink;
}

bool put(std::string_view bytes) {
    static std::mutex mutex;  // the prompt of a debugger and the run that it debugs both print
    const std::lock_guard lock(mutex);
    standard_output().write(bytes);
    return standard_output().state().ok() && !standard_output().abandoned();
}

}  // namespace

bool print(std::string_view text) {
    return put(visible_lines(text));
}

bool print_file(std::string_view content) {
    return put(content);  // the sink knows whether it is a terminal
}

int end_output(int exit_code) {
    const Status written = standard_output().flush();
    return written.ok() ? exit_code : complain(written.error());
}

void say(std::string_view lines) {
    write_to_stderr(lines);
}

int complain(std::string_view sentence, int exit_code) {
    // One write, so that the lines of several threads do not mix.
    write_to_stderr("vagus: " + std::string(sentence) + "\n");
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
