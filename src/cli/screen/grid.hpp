// A page of character cells, and the bytes that turn one page on a terminal into the next.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/screen/view.hpp"

namespace vagus::cli {

constexpr int kColumnsMax = 1000;  // a larger terminal shows this much of the page
constexpr int kRowsMax = 500;

struct Size {
    int columns = 80;
    int rows = 24;
    friend bool operator==(const Size&, const Size&) = default;
};

// No colour: what the terminal shows by itself.
using Colour = std::optional<Rgb>;

struct Ink {
    Colour fore;
    Colour back;
    bool bold = false;
    friend bool operator==(const Ink&, const Ink&) = default;
};

// glyph 0: the right half of the wide character to the left.
struct Cell {
    char32_t glyph = U' ';
    Ink ink;
    friend bool operator==(const Cell&, const Cell&) = default;
};

class Grid {
public:
    // Sizes beyond the limits are cut to them; less than 1 becomes 1.
    explicit Grid(Size size);

    Size size() const { return size_; }
    const Cell& at(int column, int row) const;
    // Outside of the page nothing happens.
    void put(int column, int row, const Cell& cell);
    // UTF-8, cut at `column_end`; control characters and broken bytes become '?'. Gives the column
    // behind the text.
    int text(int column, int row, int column_end, std::string_view text, const Ink& ink);
    void fill(int column, int row, int columns, int rows, const Cell& cell);
    // The glyphs of a row as UTF-8, without spaces at the end: for tests.
    std::string row_text(int row) const;

private:
    Size size_;
    std::vector<Cell> cells_;
};

// Columns that the text takes.
int text_width(std::string_view text);

enum class ColourDepth { None, Basic, Indexed, True };  // nothing, 16, 256, 24 bits

// What to send to a terminal that shows `before` (nullptr: anything) so that it shows `after`. Only
// what changed.
std::string repaint(const Grid* before, const Grid& after, ColourDepth depth);

}  // namespace vagus::cli
