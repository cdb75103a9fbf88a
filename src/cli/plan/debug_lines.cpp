#include "cli/plan/debug_lines.hpp"

#include <editline/readline.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "net/end_signal.hpp"

namespace vagus::cli {

namespace {

// libedit calls back without a place for what is ours: set by the one PromptLines there is.
PromptWords g_words;
volatile sig_atomic_t g_interrupted = 0;
volatile sig_atomic_t g_wake = -1;  // the writing end of a pipe that is never closed
int g_woken = -1;      // its reading end: a byte stays in it until the interrupt is taken
std::string g_unread;  // of stdin, behind the line that was taken last

void note_interrupt(int) {
    const int before = errno;
    g_interrupted = 1;
    [[maybe_unused]] const auto written = ::write(g_wake, "!", 1);
    errno = before;
}

void open_wake() {
    int ends[2];
    if (g_woken >= 0 || ::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return;
    g_woken = ends[0];
    g_wake = ends[1];
}

// libedit asks until nullptr: 0 begins a new round. What it gets is freed by it.
char* next_match(const std::vector<std::string>& words, const char* begun, int state) {
    static size_t at = 0;
    if (state == 0) at = 0;
    while (at < words.size()) {
        const std::string& word = words[at++];
        if (word.starts_with(begun)) return ::strdup(word.c_str());
    }
    return nullptr;
}
char* next_first(const char* begun, int state) {
    return next_match(g_words.first, begun, state);
}
char* next_word(const char* begun, int state) {
    return next_match(g_words.words, begun, state);
}

char** complete(const char* begun, int start, int) {
    rl_attempted_completion_over = 1;  // no names of files
    return rl_completion_matches(begun, start == 0 ? next_first : next_word);
}

enum class Came { Input, EndOfInput, Interrupt, End };

// Signals are waited for by descriptors as well: one that comes just before the wait would not
// interrupt it.
Came wait_for_input() {
    for (;;) {
        pollfd ready[3] = {
            {STDIN_FILENO, POLLIN, 0}, {g_woken, POLLIN, 0}, {net::end_descriptor(), POLLIN, 0}};
        (void)::poll(ready, 3, -1);
        if (net::end_asked()) return Came::End;
        if (g_interrupted != 0) return Came::Interrupt;
        if (ready[0].revents == 0) continue;
        char bytes[4096];
        const ssize_t count = ::read(STDIN_FILENO, bytes, sizeof bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return Came::EndOfInput;
        g_unread.append(bytes, static_cast<size_t>(count));
        return Came::Input;
    }
}

std::optional<std::string> plain_line() {
    std::string line;
    for (;;) {
        const size_t size = std::min(g_unread.find('\n'), g_unread.size());
        line.append(g_unread, 0, std::min(size, kPromptLineMax - line.size()));
        const bool whole = size < g_unread.size();
        g_unread.erase(0, whole ? size + 1 : size);
        if (whole) return line;
        switch (wait_for_input()) {
            case Came::Input:
                break;
            case Came::EndOfInput:
                return line.empty() ? std::nullopt : std::optional(line);
            case Came::Interrupt:
                return std::string();
            case Came::End:
                return std::nullopt;
        }
    }
}

}  // namespace

PromptLines::PromptLines(PromptWords words)
    : at_terminal_(::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0) {
    open_wake();
    struct sigaction action = {};
    action.sa_handler = note_interrupt;
    ::sigaction(SIGINT, &action, nullptr);
    if (!at_terminal_) return;
    g_words = std::move(words);
    rl_initialize();
    rl_attempted_completion_function = complete;
}

PromptLines::~PromptLines() {
    let_interrupts_end();
}

void PromptLines::let_interrupts_end() {
    ::signal(SIGINT, SIG_DFL);
}

std::optional<std::string> PromptLines::next(const std::string& prompt) {
    if (!at_terminal_) return plain_line();
    char* const typed = ::readline(prompt.c_str());
    if (!typed) return g_interrupted != 0 ? std::optional(std::string()) : std::nullopt;
    std::string line(typed, ::strnlen(typed, kPromptLineMax));
    std::free(typed);
    if (!line.empty()) ::add_history(line.c_str());
    if (net::end_asked()) return std::nullopt;
    return line;
}

bool PromptLines::take_interrupt() {
    const bool interrupted = g_interrupted != 0;
    char bytes[64];
    while (::read(g_woken, bytes, sizeof bytes) > 0) {
    }
    g_interrupted = 0;
    return interrupted;
}

}  // namespace vagus::cli
