#include "cli/screen/grid.hpp"

#include <algorithm>
#include <cassert>

#include "base/text.hpp"

namespace vagus::cli {
namespace {

// Of text that visible() has made well-formed.
CodePoint decode(std::string_view text) {
    const CodePoint point = first_code_point(text);
    assert(point.bytes > 0);
    return point;
}

// Columns of a character, by the blocks that terminals agree on: 0 marks that combine, 2 East Asian
// and pictures.
int glyph_width(char32_t glyph) {
    if ((glyph >= 0x300 && glyph <= 0x36f) || (glyph >= 0x200b && glyph <= 0x200f)) return 0;
    if (glyph == 0xfeff || (glyph >= 0xfe00 && glyph <= 0xfe0f)) return 0;
    const bool wide =
        (glyph >= 0x1100 && glyph <= 0x115f) || (glyph >= 0x2e80 && glyph <= 0xa4cf) ||
        (glyph >= 0xac00 && glyph <= 0xd7a3) || (glyph >= 0xf900 && glyph <= 0xfaff) ||
        (glyph >= 0xff00 && glyph <= 0xff60) || (glyph >= 0x1f300 && glyph <= 0x1faff);
    return wide ? 2 : 1;
}

// One part of the 6 x 6 x 6 cube of 256-colour terminals.
int cube_step(int value) {
    return value < 48 ? 0 : value < 115 ? 1 : (value - 35) / 40;
}

int indexed(Rgb colour) {
    const int highest = std::max({colour.r, colour.g, colour.b});
    const int lowest = std::min({colour.r, colour.g, colour.b});
    if (highest - lowest < 10) {
        const int grey = (highest + lowest) / 2;
        if (grey < 4) return 16;
        if (grey > 246) return 231;
        return 232 + std::clamp((grey - 3) / 10, 0, 23);
    }
    return 16 + 36 * cube_step(colour.r) + 6 * cube_step(colour.g) + cube_step(colour.b);
}

// 0 to 15 by the nearest of the colours that most terminals give them.
int basic(Rgb colour) {
    static constexpr Rgb kPalette[16] = {
        {0, 0, 0},     {170, 0, 0},    {0, 170, 0},    {170, 85, 0},
        {0, 0, 170},   {170, 0, 170},  {0, 170, 170},  {170, 170, 170},
        {85, 85, 85},  {255, 85, 85},  {85, 255, 85},  {255, 255, 85},
        {85, 85, 255}, {255, 85, 255}, {85, 255, 255}, {255, 255, 255}};
    int best = 0;
    int best_distance = 1 << 30;
    for (int i = 0; i < 16; i++) {
        const int r = colour.r - kPalette[i].r;
        const int g = colour.g - kPalette[i].g;
        const int b = colour.b - kPalette[i].b;
        const int distance = r * r + g * g + b * b;
        if (distance >= best_distance) continue;
        best = i;
        best_distance = distance;
    }
    return best;
}

void add_colour(const Colour& colour, bool back, ColourDepth depth, std::string& out) {
    if (!colour || depth == ColourDepth::None) return;
    if (depth == ColourDepth::True) {
        out += back ? ";48;2;" : ";38;2;";
        out += std::to_string(colour->r) + ";" + std::to_string(colour->g) + ";" +
               std::to_string(colour->b);
    } else if (depth == ColourDepth::Indexed) {
        out += (back ? ";48;5;" : ";38;5;") + std::to_string(indexed(*colour));
    } else {
        const int number = basic(*colour);
        const int base = (number < 8 ? 30 : 82) + (back ? 10 : 0);
        out += ";" + std::to_string(base + number);
    }
}

void add_ink(const Ink& ink, ColourDepth depth, std::string& out) {
    out += "\x1b[0";
    if (ink.bold) out += ";1";
    add_colour(ink.fore, false, depth, out);
    add_colour(ink.back, true, depth, out);
    out += 'm';
}

}  // namespace

Grid::Grid(Size size)
    : size_{std::clamp(size.columns, 1, kColumnsMax), std::clamp(size.rows, 1, kRowsMax)},
      cells_(static_cast<size_t>(size_.columns) * static_cast<size_t>(size_.rows)) {}

const Cell& Grid::at(int column, int row) const {
    return cells_.at(static_cast<size_t>(row) * static_cast<size_t>(size_.columns) +
                     static_cast<size_t>(column));
}

void Grid::put(int column, int row, const Cell& cell) {
    if (column < 0 || row < 0 || column >= size_.columns || row >= size_.rows) return;
    cells_[static_cast<size_t>(row) * static_cast<size_t>(size_.columns) +
           static_cast<size_t>(column)] = cell;
}

int Grid::text(int column, int row, int column_end, std::string_view text, const Ink& ink) {
    const std::string shown = visible(text);
    std::string_view words = shown;
    while (!words.empty()) {
        const CodePoint next = decode(words);
        const int width = glyph_width(next.value);
        if (column + width > column_end) break;
        words.remove_prefix(next.bytes);
        if (width == 0) continue;
        put(column, row, {next.value, ink});
        if (width == 2) put(column + 1, row, {U'\0', ink});
        column += width;
    }
    return column;
}

void Grid::fill(int column, int row, int columns, int rows, const Cell& cell) {
    for (int y = row; y < row + rows; y++) {
        for (int x = column; x < column + columns; x++) put(x, y, cell);
    }
}

std::string Grid::row_text(int row) const {
    std::string text;
    for (int column = 0; column < size_.columns; column++) {
        if (const char32_t glyph = at(column, row).glyph; glyph != 0) text += to_utf8(glyph);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

int text_width(std::string_view text) {
    const std::string shown = visible(text);
    std::string_view words = shown;
    int width = 0;
    while (!words.empty()) {
        const CodePoint next = decode(words);
        width += glyph_width(next.value);
        words.remove_prefix(next.bytes);
    }
    return width;
}

std::string repaint(const Grid* before, const Grid& after, ColourDepth depth) {
    std::string out;
    const Size size = after.size();
    const bool whole = before == nullptr || before->size() != size;
    if (whole) out += "\x1b[0m\x1b[2J";
    std::optional<Ink> ink;
    for (int row = 0; row < size.rows; row++) {
        int cursor = -1;  // the column where the terminal would write next in this row
        for (int column = 0; column < size.columns; column++) {
            const Cell& cell = after.at(column, row);
            if (!whole && before->at(column, row) == cell) continue;
            if (cell.glyph == 0) continue;
            if (cursor != column) {
                out += "\x1b[" + std::to_string(row + 1) + ";" + std::to_string(column + 1) + "H";
            }
            if (ink != cell.ink) add_ink(cell.ink, depth, out);
            ink = cell.ink;
            out += to_utf8(cell.glyph);
            cursor = column + glyph_width(cell.glyph);
        }
    }
    if (!out.empty()) out += "\x1b[0m";
    return out;
}

}  // namespace vagus::cli
