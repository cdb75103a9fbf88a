#include "cli/screen/theme.hpp"

#include <gmock/gmock.h>

namespace vagus::cli {
namespace {

TEST(Theme, TheAnswerOfATerminalTellsWhetherItIsLight) {
    const auto theme = [](const std::string& answer) {
        return read_background(answer + "\x1b[?62;22c").theme;
    };
    EXPECT_EQ(theme("\x1b]11;rgb:ffff/ffff/ffff\x1b\\"), Theme::Light);
    EXPECT_EQ(theme("\x1b]11;rgb:fdfd/f6f6/e3e3\x07"), Theme::Light);  // ended by a bell
    EXPECT_EQ(theme("\x1b]11;rgb:ff/ff/ff\x1b\\"), Theme::Light);
    EXPECT_EQ(theme("\x1b]11;rgba:ffff/ffff/ffff/8000\x1b\\"), Theme::Light);
    EXPECT_EQ(theme("\x1b]11;rgb:0000/2b2b/3636\x1b\\"), Theme::Dark);
    EXPECT_EQ(theme("\x1b]11;rgb:0000/0000\x1b\\"), std::nullopt);
    EXPECT_EQ(theme("\x1b]11;?\x1b\\"), std::nullopt);
    EXPECT_EQ(theme(""), std::nullopt);
}

TEST(Theme, TheSecondAnswerEndsTheWait) {
    EXPECT_FALSE(read_background("").complete);
    EXPECT_FALSE(read_background("\x1b]11;rgb:0/0/0\x07").complete);
    EXPECT_FALSE(read_background("\x1b]11;rgb:0/0/0\x07\x1b[?6").complete);
    EXPECT_TRUE(read_background("\x1b]11;rgb:0/0/0\x07\x1b[?6c").complete);
}

TEST(Theme, KeysThatWereTypedMeanwhileAreKept) {
    EXPECT_EQ(read_background("q\x1b]11;rgb:0/0/0\x07 \x1b[A\x1b[?6cr").typed, "q \x1b[Ar");
    EXPECT_EQ(read_background("\x1b[?6c\x1b[").typed, "\x1b[");  // its end is still to come
}

TEST(Theme, TheEnvironmentNamesTheColoursByNumber) {
    EXPECT_EQ(theme_of_colorfgbg("15;0"), Theme::Dark);
    EXPECT_EQ(theme_of_colorfgbg("0;15"), Theme::Light);
    EXPECT_EQ(theme_of_colorfgbg("0;default;7"), Theme::Light);
    EXPECT_EQ(theme_of_colorfgbg("7;8"), Theme::Dark);
    EXPECT_EQ(theme_of_colorfgbg("0;16"), std::nullopt);
    EXPECT_EQ(theme_of_colorfgbg("0;default"), std::nullopt);
    EXPECT_EQ(theme_of_colorfgbg(""), std::nullopt);
}

// The contrast of black and white is 21: (1 + 0.05) / (0 + 0.05). That of the middle grey 118 with
// white is 4.54, of 119 it is 4.48.
TEST(Theme, OnALightTerminalColoursAreDarkEnoughToRead) {
    EXPECT_EQ(readable({0, 0, 0}, Theme::Light), (Rgb{0, 0, 0}));
    EXPECT_EQ(readable({110, 110, 110}, Theme::Light), (Rgb{110, 110, 110}));
    EXPECT_LE(readable({140, 140, 140}, Theme::Light).r, 118);
    const Rgb amber = readable({255, 210, 90}, Theme::Light);
    EXPECT_GT(amber.r, amber.g);  // it stays what it is
    EXPECT_GT(amber.g, amber.b);
    EXPECT_EQ(readable({255, 210, 90}, Theme::Dark), (Rgb{255, 210, 90}));
}

TEST(Theme, OnlyTextOnTheTerminalsOwnBackgroundChanges) {
    Grid grid({3, 1});
    const Rgb bright{255, 210, 90};
    grid.put(0, 0, {U'a', {bright, std::nullopt, false}});
    grid.put(1, 0, {U'b', {bright, Rgb{0, 0, 0}, false}});
    grid.put(2, 0, {U'c', {std::nullopt, std::nullopt, false}});
    make_readable(grid, {0, 0, 3, 1}, Theme::Light);
    EXPECT_EQ(grid.at(0, 0).ink.fore, Colour(readable(bright, Theme::Light)));
    EXPECT_EQ(grid.at(1, 0).ink.fore, Colour(bright));
    EXPECT_EQ(grid.at(2, 0).ink.fore, Colour());
}

}  // namespace
}  // namespace vagus::cli
