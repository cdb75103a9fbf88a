// The terminal as a page to paint on: alternate screen, no echo, keys as they are typed. It is
// given back as it was in every way a process can end: return, Ctrl-C, kill, a crash; Ctrl-Z gives
// it back for as long as the process rests.
//
//     Result<Terminal> terminal = Terminal::open();   // at most one at a time
//     terminal.value().write(repaint(nullptr, page, look.depth));
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "cli/screen/screen.hpp"

namespace vagus::cli {

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
    // True once after the page on the terminal was lost: after Ctrl-Z and fg.
    bool take_lost();

private:
    Terminal() = default;
    bool open_ = true;
};

// Set by Ctrl-C, SIGTERM and SIGHUP once watch_for_end() was called: the loop of a verb looks at it
// and ends in order (its files complete). A second signal of the kind ends the process at once.
void watch_for_end();
bool end_asked();
// Ends the process by the signal that asked for its end, so that a shell script around it stops
// too; returns `exit_code` if none did.
int end_as_asked(int exit_code);

Look look_of_environment();

}  // namespace vagus::cli
