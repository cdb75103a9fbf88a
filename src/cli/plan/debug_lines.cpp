#include "cli/plan/debug_lines.hpp"

#include <editline/readline.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "net/end_signal.hpp"

namespace vagus::cli {

namespace {

// libedit calls back without a place for what is ours: set by the one PromptLines there is.
PromptWords g_words;
volatile sig_atomic_t g_interrupted = 0;

void note_interrupt(int) {
    g_interrupted = 1;
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

std::optional<std::string> plain_line() {
    std::string line;
    for (;;) {
        const int c = std::getc(stdin);
        if (c == EOF && std::ferror(stdin) != 0 && errno == EINTR) {  // a signal came
            std::clearerr(stdin);
            if (net::end_asked()) return std::nullopt;
            if (g_interrupted != 0) return std::string();
            continue;
        }
        if (c == EOF && line.empty()) return std::nullopt;
        if (c == EOF || c == '\n') return line;
        if (line.size() < kPromptLineMax) line.push_back(static_cast<char>(c));
    }
}

}  // namespace

PromptLines::PromptLines(PromptWords words)
    : at_terminal_(::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0) {
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
    g_interrupted = 0;
    return interrupted;
}

}  // namespace vagus::cli
