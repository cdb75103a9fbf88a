// The page that `vagus sim` shows: arena, panel, errors, a line of state, a line of keys.
//
//     const Grid page = draw(view, size, look);
//     send(repaint(&shown, page, look.depth));
#pragma once

#include <string>

#include "cli/screen/canvas.hpp"

namespace vagus::cli {

constexpr Size kSizeMin{60, 16};  // below this the page only says that it needs more room

Grid draw(const View& view, Size size, const Look& look);

// How a terminal can draw, by the variables of its environment. NO_COLOR (not empty) means no
// colour. Where no locale is set at all, as in a bare container, the terminal is taken to
// understand UTF-8, as nearly all do.
struct Environment {
    std::string term{};       // TERM
    std::string colorterm{};  // COLORTERM
    std::string no_color{};   // NO_COLOR
    std::string colorfgbg{};  // COLORFGBG: its colours, "15;0"
    std::string locale{};     // the first of LC_ALL, LC_CTYPE, LANG that is not empty
};
Look look_for(const Environment& environment);

}  // namespace vagus::cli
