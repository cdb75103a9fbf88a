// Which variables of a node are told when some of its words have changed.
#include "record/bus_messages.hpp"

#include <gtest/gtest.h>

#include "base/seconds.hpp"

namespace vagus::record {
namespace {

using Words = std::vector<int16_t>;

// "[begin, end)" of a node of ten words in which these have changed.
std::pair<size_t, size_t> range_of(const std::vector<size_t>& changed) {
    const Words before = {10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
    Words now = before;
    for (const size_t one : changed) now[one] = -1;
    const WordRange range = changed_words(before, now);
    return {range.begin, range.end};
}

TEST(ChangedWords, AreFromTheFirstToTheLast) {
    EXPECT_EQ(range_of({0}), std::pair(size_t{0}, size_t{1}));
    EXPECT_EQ(range_of({9}), std::pair(size_t{9}, size_t{10}));
    EXPECT_EQ(range_of({3, 6}), std::pair(size_t{3}, size_t{7}));
    EXPECT_EQ(range_of({4, 5}), std::pair(size_t{4}, size_t{6}));
    EXPECT_EQ(range_of({0, 9}), std::pair(size_t{0}, size_t{10}));
}

TEST(ChangedWords, OfTheSameWordsThereAreNone) {
    const auto [begin, end] = range_of({});
    EXPECT_EQ(begin, end);
    const WordRange none = changed_words(Words{}, Words{});
    EXPECT_EQ(none.begin, none.end);
}

TEST(ChangedWords, OfFewWordsAreFound) {
    const WordRange range = changed_words(Words{1, 2, 3}, Words{1, 5, 3});
    EXPECT_EQ(range.begin, 1u);
    EXPECT_EQ(range.end, 2u);
}

TEST(WordRange, TouchesAVariableWithAWordInIt) {
    const RecordedVariable list("list", 1, 4);  // 1 to 4
    EXPECT_FALSE((WordRange{0, 1}.touches(list)));
    EXPECT_TRUE((WordRange{0, 2}.touches(list)));
    EXPECT_TRUE((WordRange{4, 5}.touches(list)));
    EXPECT_FALSE((WordRange{5, 20}.touches(list)));
    EXPECT_FALSE((WordRange{2, 2}.touches(RecordedVariable("none", 2, 0))));
}

TEST(FormatVariables, WritesListsThatEndWithZeros) {
    const Words words(600);
    std::string zeros = "0";
    for (size_t i = 1; i < words.size(); ++i) zeros += ",0";
    const RecordedVariable list("list", 0, 600);
    const RecordedVariable pair("pair", 0, 2);
    std::string room;
    const std::vector<const RecordedVariable*> told = {&pair, &list};
    EXPECT_EQ(format_variables(room, {told, words, true, from_seconds(1)}),
              R"({"t":1.000000,"all":true,"set":{"pair":[0,0],"list":[)" + zeros + "]}}");
}

TEST(FormatVariables, WritesWordsOfAnyLength) {
    const RecordedVariable list("list", 0, 6);
    const std::vector<const RecordedVariable*> told = {&list};
    const Words words = {0, 9, 10, -1, 32767, -32768};
    std::string room;
    EXPECT_EQ(format_variables(room, {told, words, false, from_seconds(0.5)}),
              R"({"t":0.500000,"all":false,"set":{"list":[0,9,10,-1,32767,-32768]}})");
}

}  // namespace
}  // namespace vagus::record
