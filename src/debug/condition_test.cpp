#include "debug/condition.hpp"

#include <gtest/gtest.h>

namespace vagus::debug {
namespace {

const std::vector<aesl::VariablePlace> kVariables = {{"n", 0, 1}, {"a", 1, 3}, {"prox.left", 4, 1}};
const std::vector<aesl::Constant> kConstants = {{"FAR", 300}};

// n = 5, a = [1, 2, 3], prox.left = -7
Result<bool> holds(std::string_view text) {
    const Condition condition = TRY(Condition::parse(text, kVariables, kConstants));
    std::vector<std::vector<int16_t>> values;
    for (const aesl::VariablePlace& place : condition.variables()) {
        if (place.name == "n") values.push_back({5});
        if (place.name == "a") values.push_back({1, 2, 3});
        if (place.name == "prox.left") values.push_back({-7});
    }
    return condition.evaluate(values);
}

std::string error_of(std::string_view text) {
    const Result<bool> result = holds(text);
    return result.ok() ? "" : result.error().what;
}

TEST(Condition, KnowsTheOperatorsOfTheLanguage) {
    for (const char* text : {"n == 5",
                             "n != 4",
                             "n >= 5",
                             "n > 4",
                             "n < FAR",
                             "n <= 5",
                             "n",
                             "a[n - 3] == 3",
                             "prox.left == -7",
                             "abs prox.left == 7",
                             "-n == -5",
                             "~0 == -1",
                             "n % 2 == 1",
                             "prox.left / 2 == -3",
                             "prox.left % 2 == -1",
                             "1 << 4 == 0x10",
                             "-16 >> 2 == -4",
                             "0b101 | 2 == 7",
                             "7 ^ 2 == 5",
                             "(n == 4) == 0",
                             "n * n - 1 == 24",
                             "-32768 < 0"}) {
        const Result<bool> result = holds(text);
        ASSERT_TRUE(result.ok()) << text << ": " << result.error().what;
        EXPECT_TRUE(result.value()) << text;
    }
    for (const char* text : {"n == 4", "not n", "n - 5", "a[0] > 1", "not not (n == 4)"}) {
        const Result<bool> result = holds(text);
        ASSERT_TRUE(result.ok()) << text;
        EXPECT_FALSE(result.value()) << text;
    }
}

// Chapter 2 of the language specification: what binds tighter, and to which side.
TEST(Condition, BindsAsTheLanguageDoes) {
    EXPECT_TRUE(holds("4 & 5 == 4").value());                   // (4 & 5) == 4
    EXPECT_TRUE(holds("1 == 1 or 1 == 0 and 0 == 1").value());  // and before or
    EXPECT_TRUE(holds("not n == 4 and n == 5").value());        // (not n == 4) and …
    EXPECT_TRUE(holds("10 - 4 - 3 == 3").value());              // from the left
    EXPECT_TRUE(holds("2 + 3 * 4 == 14").value());
    EXPECT_TRUE(holds("abs -5 + 1 == 6").value());     // (abs -5) + 1
    EXPECT_TRUE(holds("1 | 6 ^ 2 & 3 == 5").value());  // 1 | (6 ^ (2 & 3)) = 1 | 4
}

TEST(Condition, ArithmeticWrapsTo16Bits) {
    EXPECT_TRUE(holds("32767 + 1 == -32768").value());
    EXPECT_TRUE(holds("300 * 300 == 24464").value());
    EXPECT_TRUE(holds("-32768 / -1 == -32768").value());
    EXPECT_TRUE(holds("1 << 16 == 0").value());
    EXPECT_TRUE(holds("1 << 32 == 1").value());
}

TEST(Condition, HasAValueLikeAnyExpression) {
    const auto value = [](std::string_view text) {
        return Condition::parse(text, kVariables, {}).value().value({{5}}).value();
    };
    EXPECT_EQ(value("n * 3 - 1"), 14);
    EXPECT_EQ(value("n > 2"), 1);
    EXPECT_EQ(value("-n"), -5);
}

TEST(Condition, ReadsEachVariableOnce) {
    const auto condition = Condition::parse("n > 1 and n < 9 or a[n] == a[0]", kVariables, {});
    ASSERT_TRUE(condition.ok());
    ASSERT_EQ(condition.value().variables().size(), 2u);
    EXPECT_EQ(condition.value().variables()[0].name, "n");
    EXPECT_EQ(condition.value().variables()[1].size, 3);
}

TEST(Condition, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(
        error_of("n == "),
        "expression, column 6: expected a variable, a constant or a number, found nothing more");
    EXPECT_EQ(error_of("n = 5"),
              "expression, column 3: expected an operator or the end, found \"= 5\"");
    EXPECT_EQ(error_of("prox.lefd > 1"),
              "expression, column 1: expected a variable or constant of the node (did you mean "
              "prox.left?), found \"prox.lefd > 1\"");
    EXPECT_EQ(
        error_of("a > 1"),
        "expression, column 3: expected \"[\" and an index, because a has 3 words, found \"> 1\"");
    EXPECT_EQ(error_of("(n"), "expression, column 3: expected \")\", found nothing more");
    EXPECT_EQ(error_of("n > 32768"),
              "expression, column 5: expected a number of 16 bits, found \"32768\"");
    EXPECT_EQ(
        error_of(""),
        "expression, column 1: expected a variable, a constant or a number, found nothing more");
}

TEST(Condition, HasAFormWhateverTheNamesAre) {
    for (const char* text : {"x", "x[y + 1] > 3 and not z", "abs (x - 1) == FAR"}) {
        EXPECT_TRUE(Condition::check_form(text).ok()) << text;
    }
    EXPECT_EQ(Condition::check_form("token >").error().what,
              "expression, column 8: expected a variable, a constant or a number, found nothing "
              "more");
    EXPECT_EQ(Condition::check_form("x[1").error().what,
              "expression, column 4: expected \"]\", found nothing more");
}

TEST(Condition, FailsWhereTheNodeWouldFault) {
    EXPECT_EQ(error_of("1 / (n - 5)"), "the expression divides by zero");
    EXPECT_EQ(error_of("1 % 0"), "the expression divides by zero");
    EXPECT_EQ(error_of("a[n]"), "the expression reads a[5], which has 3 words");
    EXPECT_EQ(error_of("a[-1]"), "the expression reads a[-1], which has 3 words");
}

TEST(Condition, HasLimits) {
    const auto nested = [](int depth) {
        return std::string(static_cast<size_t>(depth), '(') + "1" +
               std::string(static_cast<size_t>(depth), ')');
    };
    EXPECT_TRUE(holds(nested(kConditionDepthMax)).value());
    EXPECT_FALSE(holds(nested(kConditionDepthMax + 1)).ok());
    EXPECT_TRUE(holds(std::string(kConditionBytesMax - 1, ' ') + "1").value());
    EXPECT_FALSE(holds(std::string(kConditionBytesMax, ' ') + "1").ok());
    std::string sum = "1";
    while (sum.size() + 2 <= kConditionBytesMax) sum += "+1";
    EXPECT_TRUE(holds(sum).value());

    std::vector<aesl::VariablePlace> many;
    std::string all = "0";
    for (size_t i = 0; i <= kConditionVariablesMax; i++) {
        many.push_back({"v" + std::to_string(i), static_cast<uint16_t>(i), 1});
        if (i < kConditionVariablesMax) all += "+v" + std::to_string(i);
    }
    EXPECT_TRUE(Condition::parse(all, many, {}).ok());
    EXPECT_FALSE(Condition::parse(all + "+v16", many, {}).ok());
    const std::vector<aesl::VariablePlace> large = {{"w", 0, kConditionWordsMax},
                                                    {"x", 0, kConditionWordsMax + 1}};
    EXPECT_TRUE(Condition::parse("w[0]", large, {}).ok());
    EXPECT_FALSE(Condition::parse("x[0]", large, {}).ok());
}

}  // namespace
}  // namespace vagus::debug
