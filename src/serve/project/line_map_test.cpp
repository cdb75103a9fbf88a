#include "serve/project/line_map.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

constexpr std::string_view kText = "var a\n\nonevent go\n\ta = 1\n\ta = 2\n";

std::optional<int> after(std::string_view text, int line) {
    return LineMap(kText, text).after(line);
}

TEST(LineMap, LinesMoveWithWhatIsPutInOrDeletedAboveThem) {
    EXPECT_EQ(after("# one\nvar a\n\nonevent go\n\ta = 1\n\ta = 2\n", 4), 5);
    EXPECT_EQ(after("var a\nonevent go\n\ta = 1\n\ta = 2\n", 4), 3);
    EXPECT_EQ(after("var a\n\nonevent go\n\ta = 1\n\ta = 2\n\ta = 3\n", 4), 4);
}

// Enter before the first letter of a line.
TEST(LineMap, ALineThatIsPushedDownTakesItsMarkAlong) {
    EXPECT_EQ(after("var a\n\n\nonevent go\n\ta = 1\n\ta = 2\n", 3), 4);
}

TEST(LineMap, ALineThatIsChangedStaysALine) {
    EXPECT_EQ(after("var a\n\nonevent go\n\ta = 17\n\ta = 2\n", 4), 4);
    EXPECT_EQ(after("var a\n\nonevent go\n\tb = 1\n\ta = 2\n", 4), 4);
}

TEST(LineMap, ALineThatIsDeletedIsGone) {
    EXPECT_EQ(after("var a\n\nonevent go\n\ta = 2\n", 4), std::nullopt);
    EXPECT_EQ(after("var a\n\nonevent go\n\ta = 2\n", 5), 4);
    EXPECT_EQ(after("", 1), std::nullopt);
    EXPECT_EQ(LineMap("a\nb", "a").after(2), std::nullopt);
}

TEST(LineMap, OfAnotherTextNothingStays) {
    EXPECT_EQ(after("call leds.top(1,2,3)\n", 4), std::nullopt);
}

TEST(LineMap, WhereThereIsNoLineThereIsNone) {
    for (const int line : {-1, 0, 100}) EXPECT_EQ(after("x", line), std::nullopt) << line;
}

TEST(LineMap, ATextThatIsTheSameKeepsAll) {
    const LineMap map(kText, kText);
    EXPECT_TRUE(map.same());
    for (int line = 1; line <= 5; ++line) EXPECT_EQ(map.after(line), line);
}

}  // namespace
}  // namespace vagus::serve
