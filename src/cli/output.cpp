#include "cli/output.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "base/line_sink.hpp"
#include "base/log_lines.hpp"
#include "base/text.hpp"

namespace vagus::cli {

namespace {

// The process has one stdout, and one memory of what became of it.
LineSink& standard_output() {
    static LineSink sink = std::move(LineSink::open("-", LineSink::When::AtOnce).value());
    return sink;
}

// What OutputNeverWaits has begun; empty for a file, which never makes anybody wait.
struct Unwaiting {
    std::mutex mutex;  // the prompt of a debugger and the run that it debugs both print
    std::optional<LogLines> output;
    std::optional<LogLines> errors;
};

Unwaiting& unwaiting() {
    static Unwaiting its;
    return its;
}

bool put(std::string_view bytes) {
    Unwaiting& its = unwaiting();
    const std::lock_guard lock(its.mutex);
    if (its.output) return its.output->add(bytes);
    standard_output().write(bytes);
    return standard_output().state().ok() && !standard_output().abandoned();
}

void put_error(std::string_view lines) {
    Unwaiting& its = unwaiting();
    const std::lock_guard lock(its.mutex);
    if (its.errors) {
        its.errors->add(lines);
    } else {
        write_to_stderr(lines);
    }
}

bool may_wait(int descriptor) {
    struct stat file = {};
    return ::fstat(descriptor, &file) == 0 &&
           (S_ISFIFO(file.st_mode) || S_ISSOCK(file.st_mode) || ::isatty(descriptor) == 1);
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
    put_error(lines);
}

int complain(std::string_view sentence, int exit_code) {
    // One write, so that the lines of several threads do not mix.
    put_error("vagus: " + std::string(sentence) + "\n");
    return exit_code;
}

int complain(const Error& error, int exit_code) {
    return complain(error.what, exit_code);
}

void complain_left_out(std::string_view file, uint64_t samples, std::string_view of) {
    if (samples == 0) return;
    complain(std::string(file) + ": the disk was too slow, " + std::to_string(samples) +
             " samples of " + std::string(of) + " were left out");
}

OutputNeverWaits::OutputNeverWaits(Duration patience) {
    Unwaiting& its = unwaiting();
    const std::lock_guard lock(its.mutex);
    if (may_wait(STDOUT_FILENO)) its.output.emplace(STDOUT_FILENO, patience);
    if (may_wait(STDERR_FILENO)) its.errors.emplace(STDERR_FILENO, patience);
}

OutputNeverWaits::~OutputNeverWaits() {
    Unwaiting& its = unwaiting();
    const std::lock_guard lock(its.mutex);
    its.output.reset();
    its.errors.reset();
}

bool stdout_is_terminal() {
    return ::isatty(STDOUT_FILENO) == 1;
}

bool stderr_is_terminal() {
    return ::isatty(STDERR_FILENO) == 1;
}

}  // namespace vagus::cli
