// A column of text of the screen, written line by line, and the colours of its words.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "cli/screen/canvas.hpp"

namespace vagus::cli {

constexpr Rgb kHead{120, 170, 255};
constexpr Rgb kDim{140, 140, 150};
constexpr Rgb kGood{110, 200, 120};
constexpr Rgb kBad{255, 100, 90};
constexpr Rgb kFresh{255, 210, 90};
constexpr Rgb kBar{90, 190, 200};

// Writes lines from the top until the area is full.
class Page {
public:
    Page(Grid& grid, Area area, Charset charset) : grid_(grid), area_(area), charset_(charset) {}

    bool full() const { return row_ >= area_.rows; }
    int rows_left() const { return area_.rows - row_; }
    int columns() const { return area_.columns; }
    Charset charset() const { return charset_; }
    // Appends to the current line.
    void add(std::string_view words, const Ink& ink) {
        if (full()) return;
        column_ = grid_.text(area_.column + column_, area_.row + row_, area_.column + area_.columns,
                             words, ink) -
                  area_.column;
    }
    // At the right edge, shortened to the room that is left.
    void add_right(const std::string& words, const Ink& ink);
    // A whole line: a name at the left, a value at the right. Where both do not fit, each is
    // shortened in its middle; neither takes more than half then, unless the other needs less.
    void pair(const std::string& name, const Ink& name_ink, const std::string& value,
              const Ink& value_ink);
    void jump(int column) { column_ = std::max(column_, std::min(column, area_.columns)); }
    int column() const { return column_; }
    void next() {
        row_++;
        column_ = 0;
    }

private:
    Grid& grid_;
    Area area_;
    Charset charset_;
    int row_ = 0;
    int column_ = 0;
};

// "1.50"; never "-0.00".
std::string fixed(double value, int decimals);

// So many columns at most: where it is longer, its middle becomes a mark. Beginning and end of a
// name or of figures say more than what lies between.
std::string shortened(const std::string& text, int columns, Charset charset);

// "… 3 more": the line under a list of which so many do not fit.
void more(Page& page, size_t count);

// "── words ────", if a line of its list has room under it.
void heading(Page& page, std::string_view words);

}  // namespace vagus::cli
