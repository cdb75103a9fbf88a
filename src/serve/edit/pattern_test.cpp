#include "serve/edit/pattern.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

using testing::HasSubstr;

// The first match as "[from,to)", or what is wrong.
std::string first(std::string_view expression, std::string_view line, Pattern::Options options) {
    const auto made = Pattern::make(expression, options);
    if (!made.ok()) return made.error().what;
    size_t steps = 1'000'000;
    const auto match = made.value().find(line, 0, steps);
    return match ? std::string(line.substr(match->from, match->to - match->from)) : "-";
}
std::string regex(std::string_view expression, std::string_view line) {
    return first(expression, line, {.regex = true, .exact_case = true});
}

TEST(Pattern, TextsAreFoundAsTheyAre) {
    EXPECT_EQ(first("a.b", "xa.bA.B", {.exact_case = true}), "a.b");
    EXPECT_EQ(first("A.B", "xa.b", {.exact_case = true}), "-");
    EXPECT_EQ(first("SPEED", "max speed", {}), "speed");
    EXPECT_EQ(first("GRÖSE", "die gröse", {}), "gröse");
    EXPECT_EQ(first("speed", "speeds speed", {.exact_case = true, .whole = true}), "speed");
    EXPECT_EQ(first("speed", "speed_x xspeed", {.whole = true}), "-");
    EXPECT_EQ(first("=", "a=b", {.whole = true}), "=");
    EXPECT_EQ(first("speed", "“speed”", {.whole = true}), "speed");
}

TEST(Pattern, ExpressionsMeanWhatTheyDoElsewhere) {
    EXPECT_EQ(regex("a.c", "abc"), "abc");
    EXPECT_EQ(regex("a.c", "aéc"), "aéc");  // one character
    EXPECT_EQ(regex("ab*", "xabbb"), "abbb");
    EXPECT_EQ(regex("ab*?b", "abbb"), "ab");
    EXPECT_EQ(regex("a+", "baaa"), "aaa");
    EXPECT_EQ(regex("colou?r", "color"), "color");
    EXPECT_EQ(regex("a|ab", "ab"), "a");  // the first that fits
    EXPECT_EQ(regex("(ab|a)(c|bcd)", "abcd"), "abc");
    EXPECT_EQ(regex("x{2,3}", "xxxx"), "xxx");
    EXPECT_EQ(regex("x{2}", "x"), "-");
    EXPECT_EQ(regex("x{2,}", "xxxxx"), "xxxxx");
    EXPECT_EQ(regex("x{0,1}?y", "xy"), "xy");
    EXPECT_EQ(regex("x{,2}", "x{,2}"), "x{,2}");  // no repetition, as elsewhere
    EXPECT_EQ(regex("[a-c]+[^a-c]", "xabcd"), "abcd");
    EXPECT_EQ(regex("[]x]+", "]x]"), "]x]");
    EXPECT_EQ(regex("[\\d-]+", "a1-2"), "1-2");
    EXPECT_EQ(regex("\\d+\\s\\w+", "in 12 cm"), "12 cm");
    EXPECT_EQ(regex("\\D+", "12ab3"), "ab");
    EXPECT_EQ(regex("^var\\b.*$", "var speed"), "var speed");
    EXPECT_EQ(regex("^b", "ab"), "-");
    EXPECT_EQ(regex("\\Ba", "aa"), "a");
    EXPECT_EQ(regex("\\bspeed\\b", "xspeed speed"), "speed");
    EXPECT_EQ(regex("(^|,)b", "a,b"), ",b");
    EXPECT_EQ(regex("\\(\\.\\)", "(.)"), "(.)");
    EXPECT_EQ(regex("(?:ab)+", "abab"), "abab");
    EXPECT_EQ(regex("a*", "bbb"), "-");  // at least one character
    EXPECT_EQ(regex("(a*)*b", "aab"), "aab");
    EXPECT_EQ(first("[a-z]+", "ABC", {.regex = true}), "ABC");
    EXPECT_EQ(first("[A-Z]+", "abc", {.regex = true}), "abc");
}

TEST(Pattern, WrongExpressionsAreExplained) {
    for (const char* wrong : {"(a", "a)", "[a", "*a", "a\\", "\\q", "[b-a]", "a{3,2}", "(?=a)",
                              "a{1001}", "((a{1000}){1000}){1000}", "[\\", "\xff"}) {
        EXPECT_THAT(regex(wrong, "a"), HasSubstr("the expression cannot be used: ")) << wrong;
    }
    EXPECT_THAT(regex("(a", "a"), HasSubstr("missing ): (a"));
    EXPECT_THAT(regex("", "a"), HasSubstr("nothing to look for"));
    EXPECT_EQ(regex("a{1000}", std::string(1000, 'a')), std::string(1000, 'a'));
}

// Expressions that make others take for ever.
TEST(Pattern, NoExpressionTakesMoreThanItsSteps) {
    const std::string line(5000, 'a');
    for (const char* expression : {"(a+)+b", "(a|aa)+b", "(a*)*b", "(.*)(.*)(.*)(.*)b",
                                   "(a{0,30}){0,30}b", "((a?){30}){30}b"}) {
        const auto made = Pattern::make(expression, {.regex = true});
        ASSERT_TRUE(made.ok()) << expression << made.error().what;
        size_t steps = 3'000'000;
        EXPECT_FALSE(made.value().find(line, 0, steps)) << expression;
    }
    const auto made = Pattern::make("a.*b", {.regex = true});
    size_t steps = 100;
    EXPECT_FALSE(made.value().find(line, 0, steps));
    EXPECT_EQ(steps, 0u);
}

TEST(Pattern, GroupsStandInReplacements) {
    const auto made = Pattern::make("(\\w+)=(\\w+)?", {.regex = true});
    size_t steps = 10'000;
    const std::string line = "x: speed=12";
    const auto match = made.value().find(line, 0, steps);
    ASSERT_TRUE(match);
    EXPECT_EQ(made.value().replacement(*match, line, "$2 -> $1 ($0) $$1 $9 $"),
              "12 -> speed (speed=12) $1  $");
    const auto text = Pattern::make("speed", {});
    EXPECT_EQ(text.value().replacement(*match, line, "$1"), "$1");
}

}  // namespace
}  // namespace vagus::serve
