#include "cli/screen/grid.hpp"

#include <gtest/gtest.h>

namespace vagus::cli {
namespace {

TEST(Grid, TextIsCutAtItsColumnAndNeverOutsideThePage) {
    Grid grid({8, 2});
    EXPECT_EQ(grid.text(1, 0, 5, "abcdefgh", {}), 5);
    EXPECT_EQ(grid.row_text(0), " abcd");
    grid.text(0, 7, 8, "below", {});
    grid.text(6, 1, 20, "right", {});
    EXPECT_EQ(grid.row_text(1), "      ri");
}

TEST(Grid, WideCharactersTakeTwoColumnsAndCombiningMarksNone) {
    Grid grid({8, 1});
    EXPECT_EQ(grid.text(0, 0, 8, "機e\u0301x", {}), 4);
    EXPECT_EQ(grid.row_text(0), "機ex");
    EXPECT_EQ(text_width("機e\u0301x"), 4);
    // The right half would be outside: the character is left out.
    EXPECT_EQ(grid.text(7, 0, 8, "機", {}), 7);
}

// A name may come from a foreign node: it must not move the cursor or ring the bell.
TEST(Grid, ControlCharactersAndBrokenBytesAreShownEscaped) {
    const std::string name = "a\x1b[2J\xff\u202e";
    Grid grid({20, 1});
    EXPECT_EQ(grid.text(0, 0, 20, name, {}), 20);
    EXPECT_EQ(grid.row_text(0), "a\\u001b[2J\\xff\\u202e");
    EXPECT_EQ(text_width(name), 1 + 6 + 3 + 4 + 6);
}

TEST(Grid, SizesAreLimited) {
    EXPECT_EQ(Grid({kColumnsMax, kRowsMax}).size(), (Size{kColumnsMax, kRowsMax}));
    EXPECT_EQ(Grid({kColumnsMax + 1, kRowsMax + 1}).size(), (Size{kColumnsMax, kRowsMax}));
    EXPECT_EQ(Grid({0, -3}).size(), (Size{1, 1}));
}

TEST(Repaint, OnlyWhatChangedIsSent) {
    Grid before({10, 2});
    before.text(0, 0, 10, "time 1 s", {});
    Grid after = before;
    EXPECT_EQ(repaint(&before, after, ColourDepth::True), "");
    after.text(0, 0, 10, "time 2 s", {});
    EXPECT_EQ(repaint(&before, after, ColourDepth::True), "\x1b[1;6H\x1b[0m2\x1b[0m");
}

TEST(Repaint, AnotherSizeIsPaintedWhole) {
    const Grid before({10, 2});
    const std::string sent = repaint(&before, Grid({2, 1}), ColourDepth::None);
    EXPECT_EQ(sent, "\x1b[0m\x1b[2J\x1b[1;1H\x1b[0m  \x1b[0m");
}

TEST(Repaint, EachDepthNamesColoursInItsOwnWay) {
    Grid page({1, 1});
    page.put(0, 0, {U'x', {Rgb{255, 0, 0}, Rgb{0, 0, 0}, true}});
    const Grid blank({1, 1});
    const auto sent = [&](ColourDepth depth) { return repaint(&blank, page, depth); };
    EXPECT_EQ(sent(ColourDepth::True), "\x1b[1;1H\x1b[0;1;38;2;255;0;0;48;2;0;0;0mx\x1b[0m");
    EXPECT_EQ(sent(ColourDepth::Indexed), "\x1b[1;1H\x1b[0;1;38;5;196;48;5;16mx\x1b[0m");
    // (170, 0, 0) and (255, 85, 85) are the reds of the 16: the first is 85, the second 120 away.
    EXPECT_EQ(sent(ColourDepth::Basic), "\x1b[1;1H\x1b[0;1;31;40mx\x1b[0m");
    EXPECT_EQ(sent(ColourDepth::None), "\x1b[1;1H\x1b[0;1mx\x1b[0m");
}

}  // namespace
}  // namespace vagus::cli
