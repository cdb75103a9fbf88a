// Formulas, worked out by hand from docs/plans.md (P8 to P9c).
#include "plan/formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace vagus::plan {
namespace {

using testing::HasSubstr;

struct Nothing final : ObjectData {
    std::string_view tag() const override { return "nothing"; }
};

// What formulas here can use.
const std::map<std::string, Value>& variables() {
    static const std::map<std::string, Value> kVariables = {
        {"i", Value(int64_t{7})},
        {"f", Value(2.5)},
        {"b", Value(true)},
        {"s", Value(std::string("abc"))},
        {"n", Value(std::string("12"))},
        {"o", Value(Object(std::make_shared<Nothing>()))},
        {"p", Value(Object())},
        {"min", Value(int64_t{3})},
        {"low", Value(INT64_MIN)}};
    return kVariables;
}

Result<Value> value_of(std::string_view text) {
    const Formula formula = TRY(parse_formula(text));
    std::vector<Value> values;
    for (const std::string& name : formula.names()) values.push_back(variables().at(name));
    return formula.evaluate(values);
}

using Compared = std::vector<Formula::ComparedText>;

Compared compared_in(std::string_view text) {
    return parse_formula(text).value().compared_texts();
}

Result<Type> type_of(std::string_view text) {
    const Formula formula = TRY(parse_formula(text));
    std::vector<Type> types;
    for (const std::string& name : formula.names()) types.push_back(variables().at(name).type());
    return formula.type(types);
}

// "7 int", "2.5 float"; of an error its sentence.
std::string shown(std::string_view text) {
    const Result<Value> value = value_of(text);
    if (!value.ok()) return "error: " + value.error().what;
    const Result<Type> type = type_of(text);
    EXPECT_TRUE(type.ok() && type.value() == value.value().type()) << text;
    if (value.value().type() == Type::Object) return "object";
    return text_of(value.value()).value() + " " + std::string(name_of(value.value().type()));
}

using Cases = std::vector<std::pair<std::string_view, std::string_view>>;

void expect_values(const Cases& cases) {
    for (const auto& [text, expected] : cases) EXPECT_EQ(shown(text), expected) << text;
}

TEST(Formula, ComputesWithIntsAndFloats) {
    expect_values({{"1 + 2 * 3", "7 int"},
                   {"(1 + 2) * 3", "9 int"},
                   {"7 / 2", "3 int"},
                   {"-7 / 2", "-3 int"},
                   {"-7 % 3", "-1 int"},
                   {"7 % -3", "1 int"},
                   {"7 / 2.0", "3.5 float"},
                   {"10 - 2 - 3", "5 int"},
                   {"--i", "7 int"},
                   {"true + true", "2 int"},
                   {"-true", "-1 int"},
                   {"n * 2", "24 float"},
                   {"low % -1", "0 int"},
                   {"1 & 2", "12 string"},
                   {"n + 1", "121 string"},
                   {"1 + 2 & 3", "33 string"}});
}

TEST(Formula, ComparesAsNumbersOrAsTexts) {
    expect_values({{"i > f", "true bool"},
                   {"i == 7.0", "true bool"},
                   {"i != 7", "false bool"},
                   {"n < 9", "false bool"},
                   {"n < '9'", "true bool"},
                   {"'a' < 'B'", "false bool"},
                   {"b == 1", "true bool"},
                   {"9007199254740993 == 9007199254740992", "false bool"},
                   {"9007199254740993 == 9007199254740992.0", "true bool"},
                   {"-0.0 == 0", "true bool"},
                   {"o == o", "true bool"},
                   {"o != p", "true bool"},
                   {"p == p", "true bool"},
                   {"1 + 1 >= 2", "true bool"},
                   {"(1 < 2) == true", "true bool"},
                   {"s == 1", "error: the text \"abc\" is not a number"}});
}

TEST(Formula, DecidesFromTheLeftAndOnlyAsFarAsNeeded) {
    expect_values(
        {{"i > 3 or 1 / 0 > 2", "true bool"},
         {"i < 3 and 1 / 0 > 2", "false bool"},
         {"false or false or b", "true bool"},
         {"true and true and not b", "false bool"},
         {"true or false and false", "true bool"},
         {"(true or false) and false", "false bool"},
         {"not i == 7", "false bool"},
         {"not not f", "true bool"},
         {"not b or b", "true bool"},
         {"not (b and not b)", "true bool"},
         {"i and f", "true bool"},
         {"0.0 or 0", "false bool"},
         {"'true' and '1'", "true bool"},
         {"not '0'", "true bool"},
         {"b and-1", "true bool"},
         {"b and 1 / 0", "error: 1 / 0 divides by zero"},
         {"b and s", "error: the text \"abc\" is not a bool: write true, false, 1 or 0"}});
}

TEST(Formula, IfEvaluatesOneSideAndHasTheTypeOfBoth) {
    expect_values(
        {{"if(i > 3, 'big', 'small')", "big string"},
         {"if(i < 3, 1 / 0, f)", "2.5 float"},
         {"if(b, 1, 2.5)", "1 float"},
         {"if(b, 1, 2.5) / 2", "0.5 float"},
         {"if(b, 1, 2) / 2", "0 int"},
         {"if(b, true, 2)", "1 int"},
         {"if(b, true, false)", "true bool"},
         {"if(not b, 'x', 1) & 'a'", "1a string"},
         {"if(0.0, 1, 2)", "2 int"},
         {"if('true', 1, 2)", "1 int"},
         {"if(b, o, p)", "object"},
         {"if(b, if(not b, 1, 2.0), 3)", "2 float"},
         {"if(b, 1, if(b, 2, 'x')) + 1", "11 string"},
         {"if(s, 1, 2)", "error: the text \"abc\" is not a bool: write true, false, 1 or 0"}});
}

TEST(Formula, FunctionsKeepIntsWhereTheyCan) {
    expect_values({{"abs(-7)", "7 int"},
                   {"abs(-2.5)", "2.5 float"},
                   {"abs(-0.0)", "0 float"},
                   {"abs('-3')", "3 float"},
                   {"abs(true)", "1 int"},
                   {"min(3, 2, 7)", "2 int"},
                   {"min(3, 2.5)", "2.5 float"},
                   {"max(i, f)", "7 float"},
                   {"max(2, 2.0)", "2 float"},
                   {"max(-0.0, 0.0)", "-0 float"},
                   {"min(0.0, -0.0)", "0 float"},
                   {"max(9007199254740993, 9007199254740992)", "9007199254740993 int"},
                   {"clamp(i, 0, 5)", "5 int"},
                   {"clamp(-1, 0, 5.0)", "0 float"},
                   {"clamp(3, 3, 3)", "3 int"},
                   {"clamp(1, 9007199254740993, 9007199254740992.0)", "9007199254740992 float"},
                   {"sign(-0.5)", "-1 int"},
                   {"sign('-0')", "0 int"},
                   {"sign(low)", "-1 int"},
                   {"floor(-2.5)", "-3 int"},
                   {"ceil(-2.5)", "-2 int"},
                   {"round(-2.5)", "-3 int"},
                   {"round(2.5)", "3 int"},
                   {"round(0.49999999999999994)", "0 int"},
                   {"floor(9007199254740993)", "9007199254740993 int"},
                   {"floor(9.0e18)", "9000000000000000000 int"},
                   {"floor('2.5')", "2 int"}});
}

TEST(Formula, RootsAndAnglesAreFloats) {
    expect_values({{"sqrt(9)", "3 float"},
                   {"sqrt(-0.0)", "-0 float"},
                   {"sin(0)", "0 float"},
                   {"sin(180)", "0 float"},
                   {"sin(-180)", "0 float"},
                   {"sin(810)", "1 float"},
                   {"cos(90)", "0 float"},
                   {"cos(-450)", "0 float"},
                   {"cos(180)", "-1 float"},
                   {"tan(180)", "0 float"},
                   {"tan(45)", "1 float"},
                   {"tan(-225)", "-1 float"},
                   {"asin(1)", "90 float"},
                   {"asin(-1)", "-90 float"},
                   {"acos(-1)", "180 float"},
                   {"acos(0)", "90 float"},
                   {"acos(1)", "0 float"},
                   {"atan2(0, 0)", "0 float"},
                   {"atan2(-0.0, -0.0)", "0 float"},
                   {"atan2(1, 1)", "45 float"},
                   {"atan2(1, -1)", "135 float"},
                   {"atan2(-1, 0)", "-90 float"},
                   {"atan2(0, -1)", "180 float"}});
}

TEST(Formula, ErrorsSayWhatFailed) {
    expect_values(
        {{"1 / 0", "error: 1 / 0 divides by zero"},
         {"low - 1", "error: -9223372036854775808 - 1 does not fit an int of 64 bits"},
         {"low / -1", "error: -9223372036854775808 / -1 does not fit an int of 64 bits"},
         {"1e300 * 1e300", "error: 1e+300 * 1e+300 is not a finite number"},
         {"abs(low)", "error: abs(-9223372036854775808) does not fit an int of 64 bits"},
         {"clamp(1, 3, 2)", "error: clamp from 3 to 2: the high end lies below the low one"},
         {"sqrt(-1)", "error: sqrt(-1): no number below 0 has a root"},
         {"asin(2)", "error: asin(2): 2 is not from -1 to 1"},
         {"acos(-1.5)", "error: acos(-1.5): -1.5 is not from -1 to 1"},
         {"tan(90)", "error: tan(90) does not exist"},
         {"tan(-270)", "error: tan(-270) does not exist"},
         {"floor(1e300)", "error: 1e+300 does not fit an int of 64 bits"},
         {"round(9.3e18)", "error: 9.3e+18 does not fit an int of 64 bits"},
         {"abs('x')", "error: the text \"x\" is not a number"}});
}

TEST(Formula, ObjectsAreOperandsOfEqualityAndSidesOfIfOnly) {
    for (const char* text :
         {"o + 1", "o & 'a'", "-o", "not o", "o and b", "b or o", "o > o", "o == 1", "if(o, 1, 2)",
          "if(b, o, 1)", "abs(o)", "min(1, o)", "atan2(1, o)"}) {
        EXPECT_FALSE(type_of(text).ok()) << text;
    }
    EXPECT_EQ(type_of("if(b, o, p)").value(), Type::Object);
    EXPECT_EQ(type_of("o == p").value(), Type::Bool);
}

TEST(Formula, AllItsVariablesCountAsRead) {
    const Formula formula = parse_formula("if(a, b, c) + (d and e and a)").value();
    EXPECT_EQ(formula.names(), (std::vector<std::string>{"a", "b", "c", "d", "e"}));
}

TEST(Formula, NamesOfFunctionsAreSuchOnlyBeforeAParenthesis) {
    expect_values({{"min + min(min, 2)", "5 int"}, {"min (1,2)", "1 int"}});
    ASSERT_TRUE(parse_formula("if").ok());
    EXPECT_EQ(*parse_formula("if").value().single_name(), "if");
}

// ---- what cannot be read ----

TEST(FormulaText, WhatOtherLanguagesWriteGetsAdvice) {
    const Cases cases = {{"i = 3", "write == to compare"},
                         {"i === 3", "write == to compare"},
                         {"i !== 3", "write != to compare"},
                         {"i => 3", "write >="},
                         {"i =< 3", "write <="},
                         {"i <> 3", "write !="},
                         {"i && b", "write and"},
                         {"(i || b)", "write or"},
                         {"min(i | b, 2)", "write or"},
                         {"!b", "write not"},
                         {"i ! b", "write not before"},
                         {"i ** 2", "x * x"},
                         {"i ^ 2", "x * x"},
                         {"b ? 1 : 2", "if(condition, a, b)"},
                         {"i ≥ 3", "write >="},
                         {"i × 3", "write *"},
                         {"i – 3", "write - (a minus)"},
                         {"“a”", "plain quotes"},
                         {".5", "as 0.5"},
                         {"+5", "delete the +"},
                         {"i AND b", "write and"},
                         {"i Or b", "write or"}};
    for (const auto& [text, advice] : cases) {
        const auto formula = parse_formula(text);
        ASSERT_FALSE(formula.ok()) << text;
        EXPECT_THAT(formula.error().what, HasSubstr(advice)) << text;
        EXPECT_THAT(formula.error().what, HasSubstr("position")) << text;
    }
}

TEST(FormulaText, FunctionsAreNamedOrSuggested) {
    const Cases cases = {{"flor(1)", "did you mean \"floor\"?"},
                         {"MAX(1, 2)", "did you mean \"max\"?"},
                         {"foo(1)", "there are if, abs, min, max,"},
                         {"min(1)", "min at position 1 has 1 argument, but takes 2 or more"},
                         {"1 + abs()", "abs at position 5 has 0 arguments, but takes 1 argument:"},
                         {"abs(1, 2)", "abs(x)"},
                         {"if(b, 1)", "if(condition, a, b)"},
                         {"if(b, 1, 2, 3)", "has 4 arguments"},
                         {"clamp(1, 2)", "clamp(x, low, high)"}};
    for (const auto& [text, part] : cases) {
        const auto formula = parse_formula(text);
        ASSERT_FALSE(formula.ok()) << text;
        EXPECT_THAT(formula.error().what, HasSubstr(part)) << text;
    }
}

TEST(FormulaText, IsReadToItsEnd) {
    for (const char* text : {"",           " ",         "i >",
                             "and",        "not",       "i and",
                             "i or or b",  "min(1, 2",  "min(1,)",
                             "min(,1)",    "min 1",     "1 2",
                             "(1",         "1)",        "'a",
                             "1.5.2",      "2x",        "1e",
                             "i b",        "1 + not b", "-not b",
                             "i == not b", "i > 3 > 2", "i == 1 == b",
                             "a.b",        "not(",      "99999999999999999999",
                             "1e400",      "i ! = 3",   "true(1)"}) {
        EXPECT_FALSE(parse_formula(text).ok()) << text;
    }
    EXPECT_THAT(parse_formula("i > 3 > 2").error().what, HasSubstr("a < b and b < c"));
    EXPECT_THAT(parse_formula("1 + not b").error().what, HasSubstr("(not ...)"));
}

std::string repeated(std::string_view text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

TEST(FormulaText, NestsToTheLimitAndNoFurther) {
    const auto nested = [](std::string_view open, std::string_view close, int times) {
        return repeated(open, times) + "1" + repeated(close, times);
    };
    const std::pair<std::string_view, std::string_view> kinds[] = {
        {"(", ")"}, {"-", ""}, {"not ", ""}, {"abs(", ")"}, {"if(1, 1, ", ")"}};
    for (const auto& [open, close] : kinds) {
        EXPECT_TRUE(value_of(nested(open, close, kFormulaDepthMax)).ok()) << open;
        const auto deeper = parse_formula(nested(open, close, kFormulaDepthMax + 1));
        ASSERT_FALSE(deeper.ok()) << open;
        EXPECT_THAT(deeper.error().what, HasSubstr("256")) << open;
    }
    // All together; beside one another is not inside one another.
    EXPECT_TRUE(parse_formula(nested("(not -abs(", "))", kFormulaDepthMax / 4)).ok());
    EXPECT_FALSE(parse_formula(nested("(not -abs(", "))", kFormulaDepthMax / 4 + 1)).ok());
    EXPECT_TRUE(parse_formula(repeated("not (b) or abs(1) > -1 and ", 1000) + "b").ok());
}

TEST(FormulaText, HasALimitOfItsLength) {
    const std::string spaces(kFormulaBytesMax - 1, ' ');
    EXPECT_TRUE(parse_formula(spaces + "1").ok());
    EXPECT_FALSE(parse_formula(spaces + " 1").ok());
}

TEST(FormulaText, ManyArgumentsAreFine) {
    EXPECT_EQ(shown("max(" + repeated("1, ", 5000) + "9)"), "9 int");
}

TEST(Formula, TextsThatVariablesAreComparedWithAreListed) {
    EXPECT_EQ(compared_in("a == 'x' and \"y\" != b or (a) == ('z')"),
              (Compared{{0, "x"}, {1, "y"}, {0, "z"}}));
    EXPECT_EQ(compared_in("if(c, d, a == 'x') and c == ''"), (Compared{{2, "x"}, {0, ""}}));
    // Neither texts, nor compared for being the same, nor with a variable alone.
    EXPECT_EQ(compared_in("a == 1 or a < 'x' or a & 'x' == 'y' or 'x' == 'y' or a == b"),
              Compared{});
    EXPECT_EQ(compared_in("if(c, a, b) == 'x' or a == 'x' & b"), Compared{});
}

}  // namespace
}  // namespace vagus::plan
