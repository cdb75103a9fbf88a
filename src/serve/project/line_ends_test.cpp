#include "serve/project/line_ends.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "serve/project/merge.hpp"
#include "serve/project/text_change.hpp"

namespace vagus::serve {
namespace {

TEST(LineEnds, AFileIsWrittenAsItWasRead) {
    for (const std::string bytes : {"", "a", "a\n", "a\r\nb",
                                    "\xef\xbb\xbf"
                                    "a\r\n\nb\rc\n",
                                    "\r\n\r\n", "\r", "\n\r", "\r\r\n"}) {
        EXPECT_EQ(FileText::read(bytes).bytes(), bytes);
    }
}

TEST(LineEnds, EachLineEndCountsOneAndTheMarkNothing) {
    const FileText file = FileText::read(
        "\xef\xbb\xbf"
        "a\r\nb\rc\nd");
    EXPECT_EQ(file.text(), "a\nb\nc\nd");
    EXPECT_EQ(file.ends(), "mixed");
    EXPECT_EQ(FileText::read("a\r\nb\r\n").ends(), "crlf");
    EXPECT_EQ(FileText::read("a\nb").ends(), "lf");
    EXPECT_EQ(FileText::read("a").ends(), "lf");
}

TEST(LineEnds, ANewLineEndsAsTheOneBefore) {
    FileText file = FileText::read("a\r\nb\nc");
    file.apply({{1, 1, "!\n"}});  // at the end of the first line
    EXPECT_EQ(file.bytes(), "a!\r\n\r\nb\nc");
    file.apply({{7, 7, "\nd"}});  // at the end of the text
    EXPECT_EQ(file.bytes(), "a!\r\n\r\nb\nc\nd");
}

TEST(LineEnds, TwoEndsThatMeetStayTwo) {
    FileText file = FileText::read("a\rb\nc");
    file.apply({{2, 3, ""}});  // the b between them
    EXPECT_EQ(FileText::read(file.bytes()).text(), "a\n\nc");
}

// What nobody touches is saved with the bytes that it had, whatever is done around it.
TEST(LineEnds, RandomEditsKeepTheBytesOfAllOtherLines) {
    const unsigned seed = 20261123;
    std::printf("seed: %u\n", seed);
    std::mt19937 random(seed);
    const auto below = [&](size_t limit) { return random() % limit; };
    const std::vector<std::string> ends = {"\n", "\r\n"};
    const std::vector<std::string> pieces = {"", "x", "\n", "é\ny", "\n\n\n"};
    for (int round = 0; round < 300; ++round) {
        std::string bytes(below(2) ? "\xef\xbb\xbf" : "");
        const std::string mark = bytes;
        std::vector<std::string> lines;
        for (size_t i = 0; i < 8; ++i) {
            lines.push_back("line " + std::to_string(i) + ends[below(2)]);
            bytes += lines.back();
        }
        if (below(2)) {
            lines.push_back("no end");
            bytes += lines.back();
        }
        FileText file = FileText::read(bytes);
        const auto places = lines_of(file.text());
        // Inside of the lines [first, last]: what is before and after them stays.
        const size_t first = below(8);
        const size_t last = first + below(8 - first);
        const auto at = static_cast<size_t>(places[first].data() - file.text().data());
        const auto end =
            static_cast<size_t>(places[last].data() - file.text().data()) + places[last].size() - 1;
        const size_t from = at + below(end - at + 1);
        const size_t to = from + below(end - from + 1);
        file.apply({{from, to, pieces[below(pieces.size())]}});
        std::string front = mark;
        for (size_t i = 0; i < first; ++i) front += lines[i];
        std::string back;
        for (size_t i = last + 1; i < lines.size(); ++i) back += lines[i];
        EXPECT_THAT(file.bytes(), testing::StartsWith(front)) << round;
        EXPECT_THAT(file.bytes(), testing::EndsWith(back)) << round;
    }
}

// ---- what makes one text of another ----

std::string lines_of_numbers(std::mt19937& random) {
    std::string text;
    for (size_t i = random() % 12; i > 0; --i) text += std::to_string(random() % 4) + "\n";
    if (random() % 3 == 0) text += "end";
    return text;
}

TEST(Difference, RandomTextsBecomeEachOther) {
    const unsigned seed = 7;
    std::printf("seed: %u\n", seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 2000; ++round) {
        const std::string before = lines_of_numbers(random);
        const std::string after = lines_of_numbers(random);
        const auto found = differences(before, after);
        EXPECT_EQ(applied(before, found), after) << before << "--\n" << after;
        EXPECT_EQ(applied(before, in_units(before, found)), after);
    }
}

TEST(Difference, WhatIsBetweenTwoPlacesStays) {
    const auto found = differences("a\nb\nc\nd\n", "a1\nb\nc\nnew\nd\n");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].from, 1u);
    EXPECT_EQ(found[0].insert, "1");
    EXPECT_EQ(found[1].from, 6u);
    EXPECT_EQ(found[1].insert, "new\n");
}

TEST(Difference, MorePlacesThanThereMayBeAreOne) {
    std::string before, after;
    for (size_t i = 0; i <= kDifferencesMax; ++i) {
        before += "a\n";
        after += "b\n";
    }
    EXPECT_EQ(differences(before, after).size(), 1u);
    EXPECT_EQ(differences(before.substr(2), after.substr(2)).size(), kDifferencesMax);
}

// ---- what both did ----

TEST(Merge, DifferentLinesArePutTogether) {
    EXPECT_EQ(merged("a\nb\nc\n", "a1\nb\nc\n", "a\nb\nc2\n"), "a1\nb\nc2\n");
    EXPECT_EQ(merged("a\nb\nc\n", "new\na\nb\nc\n", "a\nb\n"), "new\na\nb\n");
    EXPECT_EQ(merged("a\nb\n", "a1\nb\n", "a1\nb\n"), "a1\nb\n");
    EXPECT_EQ(merged("a\r\nb\r\n", "a1\r\nb\r\n", "a\r\nb2\n"), "a1\r\nb2\n");
}

// As git or an editor of Windows does to a whole file.
TEST(Merge, OtherEndsOfAllLinesAreNoConflict) {
    EXPECT_EQ(merged("a\nb\nc\n", "a1\nb\nc\n", "a\r\nb\r\nc\r\n"), "a1\r\nb\r\nc\r\n");
    EXPECT_EQ(merged("a\r\nb\r\nc", "a\r\nnew\r\nb\r\nc", "a\nb\nc2"), "a\nnew\nb\nc2");
    EXPECT_EQ(merged("a\nb\n", "a1\nb\n", "a2\r\nb\r\n"), std::nullopt);
    EXPECT_EQ(with_both("a\nb\n", "a1\nb\n", "a2\r\nb\r\n"), "a1\r\na2\r\nb\r\n");
}

TEST(Merge, OneLineThatBothTouchIsAConflict) {
    EXPECT_EQ(merged("speed = 100\n", "speed = 150\n", "speed = 200\n"), std::nullopt);
    EXPECT_EQ(merged("a\n", "a\nmine\n", "a\ntheirs\n"), std::nullopt);
    EXPECT_EQ(merged("a\nb\nc\n", "a\nc\n", "a\nb2\nc\n"), std::nullopt);
}

TEST(Merge, BothStayWhereSomebodyHasChosenThat) {
    EXPECT_EQ(with_both("speed = 100\n", "speed = 150\n", "speed = 200\n"),
              "speed = 150\nspeed = 200\n");
    EXPECT_EQ(with_both("a\n", "a\nmine\n", "a\ntheirs\n"), "a\nmine\ntheirs\n");
    EXPECT_EQ(with_both("a\nb\nc\n", "a\nc\n", "a\nb2\nc\n"), "a\nb2\nc\n");
    // Line by line: beside it what only one of them changed.
    EXPECT_EQ(with_both("a\nb\nc\n", "a1\nb1\nc\n", "a\nb2\nc2\n"), "a1\nb1\nb2\nc2\n");
    // Two lines that one deleted and the other changed.
    EXPECT_EQ(with_both("a\nb\nc\nd\n", "a\nd\n", "a\nb2\nc2\nd\n"), "a\nb2\nc2\nd\n");
    EXPECT_EQ(with_both("a\nb\nc\n", "a1\nb\nc1\n", "a\nb\nc2\n"), "a1\nb\nc1\nc2\n");
    // A last line that does not end.
    EXPECT_EQ(with_both("a", "mine", "theirs"), "mine\ntheirs");
    EXPECT_EQ(with_both("a\n", "a1\n", "a\n"), "a1\n");
}

// Mine and theirs as changes of other lines: none is lost, whichever comes first.
TEST(Merge, RandomChangesOfOtherLinesAreAllThere) {
    const unsigned seed = 99;
    std::printf("seed: %u\n", seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 1000; ++round) {
        std::string base, mine, theirs, both;
        for (int line = 0; line < 10; ++line) {
            const std::string text = "line " + std::to_string(line) + "\n";
            const std::string other = "line " + std::to_string(line) + " changed\n";
            const auto who = random() % 4;
            base += text;
            mine += who == 0 ? other : text;
            theirs += who == 1 ? other : text;
            both += who < 2 ? other : text;
        }
        EXPECT_EQ(merged(base, mine, theirs), both) << round;
        EXPECT_EQ(merged(base, theirs, mine), both) << round;
    }
}

}  // namespace
}  // namespace vagus::serve
