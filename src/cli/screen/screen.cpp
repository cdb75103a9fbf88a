#include "cli/screen/screen.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "cli/screen/arena.hpp"
#include "cli/screen/panel.hpp"

namespace vagus::cli {
namespace {

constexpr int kPanelMin = 27;
constexpr int kPanelMax = 60;
constexpr int kProblemRowsMax = 10;
constexpr Rgb kBarBack{38, 50, 82};
constexpr Rgb kBarFore{225, 230, 240};
constexpr Rgb kKey{255, 210, 90};
constexpr Rgb kPaused{255, 180, 70};
constexpr Rgb kError{255, 110, 100};

struct KeyHelp {
    const char* key;
    const char* does;
};
constexpr KeyHelp kKeys[] = {{"space", "pause"}, {"r", "reset"},  {"+ -", "speed"}, {"tab", "robot"},
                             {"b", "button"},    {"t", "tap"},    {"q", "quit"}};

Grid too_small(Size size) {
    Grid grid(size);
    const std::string words = "vagus sim needs " + std::to_string(kSizeMin.columns) + " x " +
                              std::to_string(kSizeMin.rows) + " characters; this terminal has " +
                              std::to_string(size.columns) + " x " + std::to_string(size.rows) +
                              ". q quits.";
    // Broken at the right edge, so that the sentence is whole on any shape.
    const auto columns = static_cast<size_t>(std::max(size.columns, 1));
    for (size_t i = 0; i * columns < words.size(); i++) {
        grid.text(0, static_cast<int>(i), size.columns, words.substr(i * columns, columns), {});
    }
    return grid;
}

std::string clock_text(Time now) {
    const int64_t tenths = now.count() / 100000;
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

Ink bar_ink(Rgb fore, bool bold) { return {fore, kBarBack, bold}; }

void draw_state(Grid& grid, int row, const View& view) {
    const Size size = grid.size();
    grid.fill(0, row, size.columns, 1, {U' ', bar_ink(kBarFore, false)});
    int column = grid.text(1, row, size.columns, view.title, bar_ink(kBarFore, true));
    column = grid.text(column + 2, row, size.columns, clock_text(view.now), bar_ink(kBarFore, false));
    column = view.paused
                 ? grid.text(column + 2, row, size.columns, "paused", bar_ink(kPaused, true))
                 : grid.text(column + 2, row, size.columns, view.speed, bar_ink(kBarFore, false));
    const int left = size.columns - 1 - text_width(view.listening);
    if (!view.listening.empty() && left > column + 1) {
        grid.text(left, row, size.columns, view.listening, bar_ink(kBarFore, false));
    }
}

void draw_keys(Grid& grid, int row, const View& view) {
    const Size size = grid.size();
    int column = 1;
    for (const KeyHelp& help : kKeys) {
        const bool resumes = view.paused && std::string_view(help.does) == "pause";
        column = grid.text(column, row, size.columns, help.key, {kKey, {}, true});
        column = grid.text(column + 1, row, size.columns, resumes ? "go on" : help.does, {}) + 2;
    }
    const int left = std::max(column + 1, size.columns - 1 - text_width(view.notice));
    grid.text(left, row, size.columns, view.notice, {});
}

int problem_rows(const View& view, Size size) {
    if (view.problems.empty()) return 0;
    const int rows = static_cast<int>(std::min<size_t>(view.problems.size(), kProblemRowsMax));
    return std::min(rows + 1, size.rows / 2);
}

// The mistakes in the script, above the keys. The program that was loaded before runs on.
void draw_problems(Grid& grid, int row, int rows, const View& view) {
    const Size size = grid.size();
    const Cell bare{};
    grid.fill(0, row, size.columns, rows, bare);
    grid.fill(0, row, size.columns, 1, {U' ', {Rgb{255, 255, 255}, Rgb{150, 30, 30}, true}});
    grid.text(1, row, size.columns, "the script has mistakes; what was loaded before runs on",
              {Rgb{255, 255, 255}, Rgb{150, 30, 30}, true});
    for (int i = 1; i < rows; i++) {
        const std::string& line = view.problems[static_cast<size_t>(i - 1)];
        const bool sentence = !line.starts_with(" ");
        grid.text(1, row + i, size.columns, line,
                  {sentence ? Colour(kError) : Colour(), {}, sentence});
    }
}

struct Layout {
    Area arena;
    Area panel;
    int problems = 0;  // rows
};

// The arena takes the height and as many columns as its form needs; the panel takes the rest.
Layout layout(const View& view, Size size) {
    Layout layout;
    layout.problems = problem_rows(view, size);
    const int rows = size.rows - 2 - layout.problems;
    const double wanted = std::ceil(2.0 * rows * view.width / std::max(view.height, 1e-9));
    const int most = size.columns - kPanelMin - 1;
    const int columns = static_cast<int>(std::clamp(wanted, 1.0, 1.0 * most));
    const int panel = std::min(size.columns - columns - 1, kPanelMax);
    layout.arena = {0, 1, size.columns - panel - 1, rows};
    layout.panel = {size.columns - panel, 1, panel, rows};
    return layout;
}

bool mentions(std::string text, std::string_view word) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text.find(word) != std::string::npos;
}

ColourDepth depth_for(const Environment& environment) {
    const std::string& term = environment.term;
    if (!environment.no_color.empty() || term.empty() || term == "dumb") return ColourDepth::None;
    if (term.starts_with("vt1") || term.starts_with("vt2")) return ColourDepth::None;
    if (mentions(environment.colorterm, "truecolor") || mentions(environment.colorterm, "24bit")) {
        return ColourDepth::True;
    }
    if (mentions(term, "direct") || mentions(term, "kitty")) return ColourDepth::True;
    return mentions(term, "256") ? ColourDepth::Indexed : ColourDepth::Basic;
}

}  // namespace

Grid draw(const View& view, Size size, const Look& look) {
    if (size.columns < kSizeMin.columns || size.rows < kSizeMin.rows) return too_small(size);
    Grid grid(size);
    const Size page = grid.size();
    const Layout parts = layout(view, page);
    draw_state(grid, 0, view);
    draw_arena(grid, parts.arena, view, look);
    draw_panel(grid, parts.panel, view, look);
    if (parts.problems > 0) {
        draw_problems(grid, page.rows - 1 - parts.problems, parts.problems, view);
    }
    draw_keys(grid, page.rows - 1, view);
    return grid;
}

Look look_for(const Environment& environment) {
    const std::string& locale = environment.locale;
    const bool utf8 = locale.empty() || mentions(locale, "utf-8") || mentions(locale, "utf8");
    const bool console = environment.term == "linux" || environment.term.starts_with("vt");
    return {utf8 && !console ? Charset::Unicode : Charset::Ascii, depth_for(environment)};
}

}  // namespace vagus::cli
