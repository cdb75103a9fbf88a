// The terminal as a page to paint on: alternate screen, no echo, keys as they are typed. It is
// given back as it was in every way a process can end: return, Ctrl-C, kill, a crash; Ctrl-Z gives
// it back for as long as the process rests.
//
//     Result<Terminal> terminal = Terminal::open();   // at most one at a time
//     terminal.value().write(repaint(nullptr, page, look.depth));
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "base/time.hpp"
#include "cli/screen/screen.hpp"

namespace vagus::cli {

// Nearly all terminals answer within milliseconds; behind a slow line they are taken for dark.
constexpr Duration kAnswerWait = std::chrono::milliseconds(300);

class Terminal {
public:
    // stdin and stdout are a terminal that can move its cursor (TERM is not empty or "dumb").
    static bool can_draw();
    // Takes stdin and stdout. Unavailable if one of them is no terminal.
    static Result<Terminal> open();
    ~Terminal();
    Terminal(Terminal&&) noexcept;
    Terminal& operator=(Terminal&&) = delete;

    Size size() const;
    // False once the terminal is gone.
    bool write(std::string_view bytes);
    // What was typed since, without waiting; at most 4096 bytes at once.
    std::string read();
    // Whether its background is dark or light, by asking it; waits kAnswerWait at most. Keys that
    // are typed meanwhile are kept for read().
    std::optional<Theme> ask_background();
    // True once after the page on the terminal was lost: after Ctrl-Z and fg.
    bool take_lost();

private:
    Terminal() = default;
    bool open_ = true;
    std::string typed_;  // while it was asked
};

// How to draw on it: charset and colours by the environment; dark or light by the word of a person
// ("dark", "light"), by the terminal's own answer, by the environment.
Look look_of(Terminal& terminal, const std::string& theme);

}  // namespace vagus::cli
