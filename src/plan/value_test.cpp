// Texts of numbers and conversions, worked out by hand from docs/plans.md (P10, P11).
#include "plan/value.hpp"

#include <gtest/gtest.h>

namespace vagus::plan {
namespace {

TEST(TextOfFloat, IsPlainFromTenThousandthsToBelowTenToThe16) {
    const std::pair<double, std::string_view> cases[] = {
        {0.1, "0.1"},        {30, "30"},
        {-0.0, "-0"},        {1e20, "1e+20"},
        {1.5e-7, "1.5e-07"}, {1e-4, "0.0001"},
        {9.9e-5, "9.9e-05"}, {9999999999999998, "9999999999999998"},
        {1e16, "1e+16"},     {1e100, "1e+100"},
        {-2.5, "-2.5"},      {0.30000000000000004, "0.30000000000000004"}};
    for (const auto& [number, text] : cases) EXPECT_EQ(text_of(number), text);
}

// The text of what the value becomes; "no" if it cannot.
std::string converted(const Value& value, Type type) {
    const Result<Value> made = convert(value, type);
    if (!made.ok()) return "no";
    EXPECT_EQ(made.value().type(), type);
    return type == Type::Object ? "object" : text_of(made.value()).value();
}

Value text(std::string_view value) {
    return Value(std::string(value));
}

TEST(Sentences, HaveSixDigitsOfAFloatThatHasMore) {
    EXPECT_EQ(in_words(Value{29.83247184753418}), "29.8325");
    EXPECT_EQ(in_words(Value{-1.2837483}), "-1.28375");
    EXPECT_EQ(in_words(Value{0.1 + 0.2}), "0.3");  // 0.30000000000000004
    EXPECT_EQ(in_words(Value{1234567.0}), "1234570");
    EXPECT_EQ(in_words(Value{20.0}), "20");
    EXPECT_EQ(in_words(Value{0.0}), "0");
    // Read as what they are compared with, they would be no mistake.
    EXPECT_EQ(in_words(Value{29.9999999}), "29.9999999");
    EXPECT_EQ(in_words(Value{30.000001}), "30.000001");
    EXPECT_EQ(in_words(Value{1e300}), "1e+300");
    EXPECT_EQ(in_words(Value{int64_t{12345678}}), "12345678");
}

TEST(Conversion, FloatsRoundHalfAwayFromZeroToInts) {
    const std::pair<double, std::string_view> cases[] = {
        {2.5, "3"},
        {-2.5, "-3"},
        {2.4, "2"},
        {-0.4, "0"},
        {9.3e18, "no"},
        {-9.3e18, "no"},
        {9223372036854774784.0, "9223372036854774784"},
        {9223372036854775808.0, "no"},
        {-9223372036854775808.0, "-9223372036854775808"}};
    for (const auto& [number, expected] : cases) {
        EXPECT_EQ(converted(Value(number), Type::Int), expected) << number;
    }
}

TEST(Conversion, TextsAreNumbersWithNothingAround) {
    const std::tuple<std::string_view, std::string_view, std::string_view> cases[] = {
        {"12", "12", "12"},
        {"-12", "-12", "-12"},
        {"2.5", "3", "2.5"},
        {"1e3", "1000", "1000"},
        {"1E-1", "0", "0.1"},
        {"9007199254740993", "9007199254740993", "9007199254740992"},
        {"99999999999999999999", "no", "1e+20"},
        {" 1", "no", "no"},
        {"1 ", "no", "no"},
        {"- 1", "no", "no"},
        {"--1", "no", "no"},
        {"+1", "no", "no"},
        {"", "no", "no"},
        {".5", "no", "no"},
        {"1.", "no", "no"},
        {"0x10", "no", "no"},
        {"true", "no", "no"},
        {"1e400", "no", "no"},
        {"1e-400", "0", "0"}};
    for (const auto& [written, as_int, as_float] : cases) {
        EXPECT_EQ(converted(text(written), Type::Int), as_int) << written;
        EXPECT_EQ(converted(text(written), Type::Float), as_float) << written;
    }
}

TEST(Conversion, OnlyFourTextsAreBools) {
    for (const char* yes : {"true", "1"}) EXPECT_EQ(converted(text(yes), Type::Bool), "true");
    for (const char* no : {"false", "0"}) EXPECT_EQ(converted(text(no), Type::Bool), "false");
    for (const char* other : {"", "TRUE", "True", "yes", "2", "1.0", " 1"}) {
        EXPECT_EQ(converted(text(other), Type::Bool), "no") << other;
    }
}

TEST(Conversion, NumbersAndBools) {
    EXPECT_EQ(converted(Value(int64_t{-3}), Type::Bool), "true");
    EXPECT_EQ(converted(Value(-0.0), Type::Bool), "false");
    EXPECT_EQ(converted(Value(0.1), Type::Bool), "true");
    EXPECT_EQ(converted(Value(true), Type::Float), "1");
    EXPECT_EQ(converted(Value(INT64_MAX), Type::Float), "9.223372036854776e+18");
    EXPECT_EQ(converted(Value(true), Type::String), "true");
    EXPECT_EQ(converted(Value(1.5e-7), Type::String), "1.5e-07");
}

TEST(Conversion, ObjectsStayObjects) {
    const Value object{Object()};
    EXPECT_EQ(converted(object, Type::Object), "object");
    for (const Type type : {Type::Bool, Type::Int, Type::Float, Type::String}) {
        EXPECT_EQ(converted(object, type), "no");
        EXPECT_EQ(converted(default_of(type), Type::Object), "no");
    }
}

}  // namespace
}  // namespace vagus::plan
