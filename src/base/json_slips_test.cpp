#include "base/json_slips.hpp"

#include <gtest/gtest.h>

#include "base/json.hpp"

namespace vagus {
namespace {

// "LINE:COL sentence" as parse_json() tells it.
std::string told(std::string_view text) {
    const auto parsed = parse_json(text, "f");
    if (parsed.ok()) return "no error";
    std::string what = parsed.error().what.substr(2);
    const std::string prefix = ": this is not JSON:";
    const size_t at = what.find(prefix);
    return at == what.npos ? what : what.erase(at, prefix.size());
}

TEST(JsonSlips, AMissingComma) {
    EXPECT_EQ(told("{\n  \"a\": 1\n  \"b\": 2\n}\n"),
              "3:3 there is no comma before this; add one at line 2, column 9");
    EXPECT_EQ(told("[1 2]"), "1:4 there is no comma before this; add one at line 1, column 3");
    EXPECT_EQ(told("{\"é\": {} \"b\": 2}"),
              "1:10 there is no comma before this; add one at line 1, column 9");
}

TEST(JsonSlips, ACommaTooMany) {
    EXPECT_EQ(told("{\"a\": [1, 2,\n]}"),
              "2:1 there is a comma before this ], and nothing behind the comma; remove the comma "
              "of line 1, column 12");
    EXPECT_EQ(told("[1,,2]"),
              "1:4 there is nothing before this comma; remove it, or write a value");
    EXPECT_EQ(told("{,}"), "1:2 there is nothing before this comma; remove it");
}

TEST(JsonSlips, Comments) {
    const std::string sentence =
        "JSON has no comments; remove this one (a \"help\" can say the same)";
    EXPECT_EQ(told("{ // robots\n}"), "1:3 " + sentence);
    EXPECT_EQ(told("{\"a\": 1, /* b */ \"c\": 2}"), "1:10 " + sentence);
    EXPECT_EQ(told("# a world\n{}"), "1:1 " + sentence);
    EXPECT_EQ(told("{} // end"), "1:4 " + sentence);
}

TEST(JsonSlips, OtherQuotes) {
    EXPECT_EQ(told("{'a': 1}"),
              "1:2 a key is written in plain double quotes, not in single ones; write \"a\"");
    EXPECT_EQ(told("{\"a\": 'b c'}"),
              "1:7 a text is written in plain double quotes, not in single ones; write \"b c\"");
    EXPECT_EQ(told("{\"a\": “b”}"),
              "1:7 a text is written in plain double quotes, not in typographic ones; write \"b\"");
    EXPECT_EQ(told("{„a“: 1}"),
              "1:2 a key is written in plain double quotes, not in typographic ones; write \"a\"");
}

TEST(JsonSlips, WordsWithoutQuotes) {
    EXPECT_EQ(told("{ a: 1 }"), "1:3 a key is written in double quotes; write \"a\"");
    EXPECT_EQ(told("{ 12: 1 }"), "1:3 a key is written in double quotes; write \"12\"");
    EXPECT_EQ(told("[blue]"), "1:2 a text is written in double quotes; write \"blue\"");
    EXPECT_EQ(told("[True]"), "1:2 JSON has no True; write true");
    EXPECT_EQ(told("[False]"), "1:2 JSON has no False; write false");
    EXPECT_EQ(told("[None]"), "1:2 JSON has no None; write null");
    EXPECT_EQ(told("[ture]"), "1:2 JSON has no ture; write true");
    EXPECT_EQ(told("[NaN]"), "1:2 JSON has no NaN; write a number");
}

TEST(JsonSlips, Brackets) {
    EXPECT_EQ(told("{\n \"a\": [1, 2\n}\n"),
              "3:1 this } does not close the [ of line 2, column 7; close that with ] before it");
    EXPECT_EQ(told("{\"a\": {\n"),
              "2:1 the text ends, but the { of line 1, column 7 is not closed; add }");
    EXPECT_EQ(told("[1]]"), "1:4 this ] closes nothing; remove it");
    EXPECT_EQ(told("[}"),
              "1:2 this } does not close the [ of line 1, column 1; close that with ] before it");
    EXPECT_EQ(told(""), "1:1 there is nothing in it; write { … }");
}

TEST(JsonSlips, KeysAndValues) {
    EXPECT_EQ(told("{\"a\" = 1}"),
              "1:6 a colon, not =, separates a key and its value; write \"a\": …");
    EXPECT_EQ(told("{\"a\", \"b\": 1}"), "1:5 the key \"a\" has no value; write \"a\": …");
    EXPECT_EQ(told("{\"a\":}"), "1:6 the key before this } has no value; write one");
    EXPECT_EQ(
        told("[\"a\": 1]"),
        "1:5 a key and its value belong in an object, { … }, not in an array; use braces, or a "
        "comma");
    EXPECT_EQ(told("[1; 2]"), "1:3 values are separated by commas, not by semicolons");
    EXPECT_EQ(told("[\"say \"hi\"\"]"),
              "1:8 a quote inside of a text is written \\\"; or is a comma missing here?");
    EXPECT_EQ(
        told("[\xc2\xa0"
             "1]"),
        "1:2 the character U+00A0 looks like a space, but is none in JSON; replace it with an "
        "ordinary space");
}

TEST(JsonSlips, Numbers) {
    EXPECT_EQ(told("[+5]"), "1:2 a number begins with a digit or a minus sign; write 5 for +5");
    EXPECT_EQ(told("[.5]"), "1:2 a number begins with a digit or a minus sign; write 0.5 for .5");
    EXPECT_EQ(told("[5.]"), "1:2 5. has no digit behind its point; write 5.0");
    EXPECT_EQ(told("[007]"), "1:2 007 begins with a zero; leave the zero out");
    EXPECT_EQ(told("[1e]"), "1:2 this number has no digit in its exponent; write one, as 1e3");
    const std::string none =
        " is no number of JSON; write decimal digits only, as 16 or 0.5, or a "
        "text in quotes";
    EXPECT_EQ(told("[0x10]"), "1:2 0x10" + none);
    EXPECT_EQ(told("[5cm]"), "1:2 5cm" + none);
    EXPECT_EQ(told("[-]"), "1:2 - is no number; write digits behind the minus sign");
}

TEST(JsonSlips, Texts) {
    EXPECT_EQ(told("[\"a\n\"]"),
              "1:4 the text that begins at line 1, column 2 is not closed on its line; add a \" (a "
              "new line in a text is \\n)");
    EXPECT_EQ(told("[\"a"), "1:4 the text that begins at line 1, column 2 is not closed; add a \"");
    EXPECT_EQ(told("[\"a\tb\"]"), "1:4 a tab in a text is written \\t");
    EXPECT_EQ(told("[\"C:\\dir\"]"), "1:5 JSON has no \\d; a backslash itself is written \\\\");
    EXPECT_EQ(told("[\"\\u12\"]"), "1:3 \\u has four hexadecimal digits behind it, as \\u00e9");
}

// What the finder walks over without a word must be JSON, or the reader's own sentence is told.
TEST(JsonSlips, NothingIsSaidOfJson) {
    for (const std::string_view text :
         {R"({"a": [1, -2.5e-3, 0, true, false, null, "\u00e9\\\"/"], "b": {}, "c": []})", "7",
          "\"x\"", " [ ] \r\n"}) {
        EXPECT_FALSE(find_json_slip(text).has_value()) << text;
    }
}

}  // namespace
}  // namespace vagus
