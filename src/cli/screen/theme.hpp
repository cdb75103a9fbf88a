// Whether a terminal is dark or light: asked, or guessed from its environment; and colours that can
// be read on it.
//
//     send(kAskBackground);
//     BackgroundAnswer answer;
//     while (!answer.complete && in_time()) answer = read_background(bytes += receive());
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cli/screen/canvas.hpp"

namespace vagus::cli {

// Asks for the colour of the background (OSC 11), then what the terminal is, which nearly every one
// answers: after that answer the first will not come any more.
constexpr std::string_view kAskBackground = "\x1b]11;?\x1b\\\x1b[c";

struct BackgroundAnswer {
    bool complete = false;
    std::optional<Theme> theme;
    std::string typed;  // what is no answer: keys
};

// What came back so far.
BackgroundAnswer read_background(std::string_view bytes);

// "15;0", foreground and background as numbers of the 16 colours.
std::optional<Theme> theme_of_colorfgbg(std::string_view value);

// The colour, darker where it would not be read on a white background: at least 4.5 to 1.
Rgb readable(Rgb colour, Theme theme);

// The same for all text of an area that is on the background of the terminal.
void make_readable(Grid& grid, Area area, Theme theme);

}  // namespace vagus::cli
