// Where the commands of a prompt come from: a person at a terminal, with editing, history and
// completion, or lines of stdin. One at a time.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vagus::cli {

constexpr size_t kPromptLineMax = 64 * 1024;  // bytes; what a longer line has beyond is left out

// `first`: what a line can begin with; `words`: what can follow.
struct PromptWords {
    std::vector<std::string> first;
    std::vector<std::string> words;
};

class PromptLines {
public:
    explicit PromptLines(PromptWords words);
    ~PromptLines();
    PromptLines(const PromptLines&) = delete;
    PromptLines& operator=(const PromptLines&) = delete;

    // Nothing at the end of the input, and when a signal asks for the end. An empty line also after
    // Ctrl-C.
    std::optional<std::string> next(const std::string& prompt);
    // True once after Ctrl-C.
    bool take_interrupt();
    // From now on Ctrl-C ends the process at once.
    void let_interrupts_end();
    bool at_terminal() const { return at_terminal_; }

private:
    bool at_terminal_;
};

}  // namespace vagus::cli
