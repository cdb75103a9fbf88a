#include "cli/screen/screen.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "cli/screen/arena.hpp"
#include "cli/screen/page.hpp"
#include "cli/screen/panel.hpp"
#include "cli/screen/plan_panel.hpp"
#include "cli/screen/theme.hpp"

namespace vagus::cli {
namespace {

constexpr int kPanelMin = 28;         // with a column of margin at the right
constexpr double kPanelShare = 0.36;  // of the columns, where the arena would take more
constexpr int kPanelMax = 60;
constexpr int kProblemRowsMax = 10;
constexpr std::string_view kIndent = "  ";  // of a sentence's further rows
constexpr Rgb kBarBack{38, 50, 82};
constexpr Rgb kBarFore{225, 230, 240};
constexpr int kListeningMax = 40;  // columns of where others may connect
constexpr Rgb kKey{255, 210, 90};
constexpr Rgb kPaused{255, 180, 70};
constexpr Rgb kError{255, 110, 100};

Grid too_small(Size size) {
    Grid grid(size);
    const std::string words = "this view needs " + std::to_string(kSizeMin.columns) + " x " +
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

Ink bar_ink(Rgb fore, bool bold) {
    return {fore, kBarBack, bold};
}

void draw_state(Grid& grid, int row, const View& view, Charset charset) {
    const Size size = grid.size();
    grid.fill(0, row, size.columns, 1, {U' ', bar_ink(kBarFore, false)});
    const std::string title = shortened(view.title, size.columns / 3, charset);
    int column = grid.text(1, row, size.columns, title, bar_ink(kBarFore, true));
    column =
        grid.text(column + 2, row, size.columns, clock_text(view.now), bar_ink(kBarFore, false));
    const bool over = view.plan && view.plan->over;
    column = over ? column
             : view.paused
                 ? grid.text(column + 2, row, size.columns, "paused", bar_ink(kPaused, true))
                 : grid.text(column + 2, row, size.columns, view.speed, bar_ink(kBarFore, false));
    const int half = std::min(kListeningMax, (size.columns - column) / 2);
    const std::string listening =
        shortened(view.listening, view.notice.empty() ? size.columns - column - 3 : half, charset);
    const int left = size.columns - 1 - text_width(listening);
    grid.text(left, row, size.columns, listening, bar_ink(kBarFore, false));
    const int room = (listening.empty() ? size.columns : left) - 2 - (column + 2);
    if (room <= 0) return;
    grid.text(column + 2, row, column + 2 + room, shortened(view.notice, room, charset),
              bar_ink(kKey, false));
}

// The keys that fit whole, the needed ones first.
void draw_keys(Grid& grid, int row, const View& view) {
    const Size size = grid.size();
    int column = 1;
    for (const auto& [key, does] : view.keys) {
        const int width = text_width(key) + 1 + text_width(does);
        if (column + width > size.columns) return;
        column = grid.text(column, row, size.columns, key, {kKey, {}, true});
        column = grid.text(column + 1, row, size.columns, does, {}) + 2;
    }
}

// Sentences are broken at spaces, so that nothing of them is lost on a narrow screen; lines of the
// script and the carets under them are only cut.
struct ProblemRow {
    std::string text;
    bool begins = false;  // a sentence
};

std::vector<ProblemRow> broken(const std::vector<ProblemView>& problems, int columns) {
    std::vector<ProblemRow> rows;
    for (const ProblemView& problem : problems) {
        std::string line = problem.sentence;
        bool begins = true;
        while (text_width(line) > columns) {
            const size_t end = line.rfind(' ', static_cast<size_t>(columns));
            if (end == std::string::npos || end <= kIndent.size()) break;
            rows.push_back({line.substr(0, end), begins});
            line = std::string(kIndent) + line.substr(end + 1);
            begins = false;
        }
        rows.push_back({line, begins});
        for (const std::string& source : problem.source) rows.push_back({source, false});
    }
    return rows;
}

// What is wrong with the scripts, above the keys.
void draw_problems(Grid& grid, int row, const std::string& title,
                   const std::vector<ProblemRow>& rows) {
    const int columns = grid.size().columns;
    const Ink head{Rgb{255, 255, 255}, Rgb{150, 30, 30}, true};
    grid.fill(0, row, columns, 1, {U' ', head});
    grid.text(1, row, columns, title, head);
    for (const ProblemRow& line : rows) {
        row++;
        const Colour colour = line.begins ? Colour(kError) : Colour();
        grid.text(1, row, columns, line.text, {colour, {}, line.begins});
    }
}

struct Parts {
    Area arena;
    Area panel;
    std::vector<ProblemRow> problems;
};

// The arena takes the height and as many columns as its form needs; the panel takes the rest.
Parts parts_of(const View& view, Size size) {
    Parts parts;
    parts.problems = broken(view.problems, size.columns - 2);
    const auto most_rows = static_cast<size_t>(std::min(kProblemRowsMax, size.rows / 2));
    if (parts.problems.size() > most_rows) parts.problems.resize(most_rows);
    const int under = parts.problems.empty() ? 0 : static_cast<int>(parts.problems.size()) + 1;
    const int rows = size.rows - 2 - under;
    const double wanted = std::ceil(2.0 * rows * view.width / std::max(view.height, 1e-9));
    const int reserved = std::max(kPanelMin, static_cast<int>(kPanelShare * size.columns));
    const int most = size.columns - reserved - 1;
    const int columns = static_cast<int>(std::clamp(wanted, 1.0, 1.0 * most));
    const int panel = std::min(size.columns - columns - 1, kPanelMax);
    parts.arena = {0, 1, size.columns - panel - 1, rows};
    parts.panel = {size.columns - panel, 1, panel - 1, rows};
    return parts;
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
    const Parts parts = parts_of(view, page);
    draw_state(grid, 0, view, look.charset);
    draw_arena(grid, parts.arena, view, look);
    if (view.plan) {
        draw_plan_panel(grid, parts.panel, view, look);
    } else {
        draw_panel(grid, parts.panel, view, look);
    }
    if (!parts.problems.empty())
        draw_problems(grid, 1 + parts.arena.rows, view.problems_title, parts.problems);
    draw_keys(grid, page.rows - 1, view);
    make_readable(grid, parts.panel, look.theme);
    const int under = 1 + parts.arena.rows;
    make_readable(grid, {0, under, page.columns, page.rows - under}, look.theme);
    return grid;
}

Look look_for(const Environment& environment) {
    const std::string& locale = environment.locale;
    const bool utf8 = locale.empty() || mentions(locale, "utf-8") || mentions(locale, "utf8");
    const bool console = environment.term == "linux" || environment.term.starts_with("vt");
    return {utf8 && !console ? Charset::Unicode : Charset::Ascii, depth_for(environment),
            theme_of_colorfgbg(environment.colorfgbg).value_or(Theme::Dark)};
}

}  // namespace vagus::cli
