#include "base/json.hpp"
#include "base/test_places.hpp"

#include <gtest/gtest.h>

#include "base/file.hpp"

namespace vagus {
namespace {

std::string error_of(std::string_view text) {
    const auto parsed = parse_json(text, "f");
    return parsed.ok() ? "no error" : parsed.error().what;
}

TEST(JsonValue, KnowsThePlaceOfEveryKeyAndValue) {
    const JsonValue json =
        parse_json("{ \"a\": [1,\n  \"é\", true],\n\t\"b\" : null }", "f").value();
    EXPECT_EQ(json.at, (Place{1, 1}));
    ASSERT_EQ(json.members.size(), 2u);
    EXPECT_EQ(json.members[0].at, (Place{1, 3}));
    const JsonValue& list = json.members[0].value;
    EXPECT_EQ(list.at, (Place{1, 8}));
    EXPECT_EQ(list.items[0].at, (Place{1, 9}));
    EXPECT_EQ(list.items[1].at, (Place{2, 3}));
    EXPECT_EQ(list.items[2].at, (Place{2, 8})) << "a column is a code point, not a byte";
    EXPECT_EQ(json.members[1].at, (Place{3, 2}));
    EXPECT_EQ(json.members[1].value.at, (Place{3, 8}));
}

TEST(JsonValue, KeepsOrderDoubleKeysAndRawText) {
    const JsonValue json = parse_json(R"({"b": 1.50, "a": "\u0041\n", "b": -0})", "f").value();
    ASSERT_EQ(json.members.size(), 3u);
    EXPECT_EQ(json.members[0].key, "b");
    EXPECT_EQ(json.members[0].raw_key, "\"b\"");
    EXPECT_EQ(json.members[0].value.kind, JsonKind::Float);
    EXPECT_EQ(json.members[0].value.text, "1.50");
    EXPECT_EQ(json.members[1].value.text, "A\n");
    EXPECT_EQ(json.members[1].value.raw, R"("\u0041\n")");
    EXPECT_EQ(json.members[2].key, "b");
    EXPECT_EQ(json.members[2].value.kind, JsonKind::Int);
    EXPECT_EQ(json.members[2].value.text, "-0");
    EXPECT_EQ(json.find("b"), &json.members[0].value);
    EXPECT_EQ(json.find("c"), nullptr);
}

TEST(JsonValue, ReadsNumbersToTheirLimits) {
    EXPECT_EQ(parse_json("9223372036854775807", "f").value().integer, INT64_MAX);
    EXPECT_EQ(parse_json("-9223372036854775808", "f").value().integer, INT64_MIN);
    EXPECT_EQ(parse_json("1e-999", "f").value().number, 0.0);
    EXPECT_EQ(parse_json("0e999", "f").value().number, 0.0);
    EXPECT_EQ(parse_json("1e308", "f").value().number, 1e308);
    EXPECT_EQ(parse_json("7", "f").value().number, 7.0) << "a whole number is a number, too";
}

TEST(JsonValue, RefusesNumbersBeyondTheirLimits) {
    EXPECT_EQ(error_of("9223372036854775808").substr(0, 49),
              "f:1:1: the whole number does not fit 64 bits; wri");
    EXPECT_EQ(error_of("[-9223372036854775809]").substr(0, 6), "f:1:2:");
    EXPECT_EQ(error_of("[1e309]"),
              "f:1:2: the number 1e309 is out of range; write one between -1.7e308 and 1.7e308");
    EXPECT_EQ(error_of("[1" + std::string(400, '0') + "]").substr(0, 6), "f:1:2:");
}

TEST(JsonValue, SaysWhereAndWhyTextIsNotJson) {
    EXPECT_EQ(error_of("{\"a\": 1,}"),
              "f:1:9: this is not JSON: there is a comma before this }, and nothing behind the "
              "comma; remove the comma of line 1, column 8");
    EXPECT_EQ(error_of("{\n \"a\" 1}"),
              "f:2:6: this is not JSON: there is no colon behind the key \"a\"; write \"a\": …");
    EXPECT_EQ(
        error_of("[1, 2"),
        "f:1:6: this is not JSON: the text ends, but the [ of line 1, column 1 is not closed; "
        "add ]");
    EXPECT_EQ(error_of("[1] x"),
              "f:1:5: this is not JSON: the value is over, but more follows it; remove that");
    EXPECT_EQ(error_of("[1,,2]").substr(0, 6), "f:1:4:");
    EXPECT_EQ(error_of("{1234: 1}").substr(0, 6), "f:1:2:");
    EXPECT_EQ(error_of("{\"a\" \"b\"}").substr(0, 6), "f:1:6:");
    EXPECT_EQ(error_of("").substr(0, 6), "f:1:1:");
    EXPECT_EQ(error_of("[01]").substr(0, 6), "f:1:2:");
    EXPECT_EQ(error_of("// c\n1").substr(0, 6), "f:1:1:");
    EXPECT_EQ(error_of("NaN").substr(0, 24), "f:1:1: this is not JSON:");
    EXPECT_EQ(error_of("\"a\nb\"").substr(0, 24), "f:1:3: this is not JSON:");
}

TEST(JsonValue, RefusesWhatIsNotUnicode) {
    EXPECT_EQ(error_of("\"\\ud800\"").substr(0, 4), "f:1:");
    EXPECT_EQ(error_of("\"\\udc00\"").substr(0, 4), "f:1:");
    EXPECT_EQ(error_of("\"\\ud800\\u0041\"").substr(0, 4), "f:1:");
    EXPECT_EQ(parse_json("\"\\ud83e\\udd16\"", "f").value().text, "\xf0\x9f\xa4\x96");
    EXPECT_EQ(error_of("\"é\xff\""), "f:1:3: this byte is not UTF-8; save the file as UTF-8");
    EXPECT_EQ(error_of("\xef\xbb\xbf{}"),
              "f:1:1: the text begins with a byte order mark; save it without one");
    EXPECT_EQ(error_of(std::string_view("1\0x", 3)).substr(0, 6), "f:1:2:");
}

TEST(JsonValue, DepthIsLimited) {
    const auto nested = [](size_t depth) {
        return std::string(depth, '[') + std::string(depth, ']');
    };
    EXPECT_EQ(error_of(nested(kJsonDepthMax)), "no error");
    EXPECT_EQ(error_of(nested(kJsonDepthMax + 1)).substr(0, 8), "f:1:101:");
    EXPECT_EQ(error_of(std::string(5'000'000, '[')).substr(0, 8), "f:1:101:");
}

TEST(JsonValue, SizeAndNumberOfValuesAreLimited) {
    std::string many = "[";
    for (size_t i = 1; i < kJsonValuesMax; ++i) many += i == 1 ? "1" : ",1";
    EXPECT_EQ(error_of(many + "]"), "no error");
    EXPECT_NE(error_of(many + ",1]").find("more than 1000000 values"), std::string::npos);

    EXPECT_EQ(error_of("1" + std::string(kJsonBytesMax - 1, ' ')), "no error");
    EXPECT_EQ(error_of("1" + std::string(kJsonBytesMax, ' ')).substr(0, 42),
              "f:1:1: the text is larger than 64 MB, the ");
}

TEST(JsonValue, FormattingTheExampleChangesNoByte) {
    const std::string text = read_file(test::testdata("plans/WallFollow.plan.json")).value();
    EXPECT_EQ(format_json(parse_json(text, "f").value()), text);
}

TEST(JsonValue, FormatsTheSavedForm) {
    const JsonValue json =
        parse_json(R"({"a":{"b":{"c":1,"d":[]}, "e":{}},"f":[{"g":1.50},[2,"\u0041"]]})", "f")
            .value();
    EXPECT_EQ(format_json(json), R"({
  "a": {
    "b": { "c": 1, "d": [] },
    "e": {}
  },
  "f": [{ "g": 1.50 }, [2, "\u0041"]]
}
)");
}

// The line with indentation, key and comma may have 100 characters: 2 + 5 + 2 + 90 + 1.
TEST(JsonValue, ALineOf101CharactersIsBroken) {
    const std::string fits = "{\n  \"k\": [\"" + std::string(88, 'x') + "\"],\n  \"l\": 1\n}\n";
    ASSERT_EQ(fits.find(",\n") - 1, 100u);
    EXPECT_EQ(format_json(parse_json(fits, "f").value()), fits);
    const std::string long_one = "{\"k\": [\"" + std::string(89, 'x') + "\"], \"l\": 1}";
    EXPECT_EQ(format_json(parse_json(long_one, "f").value()),
              "{\n  \"k\": [\n    \"" + std::string(89, 'x') + "\"\n  ],\n  \"l\": 1\n}\n");
    // Without the comma the same array fits again.
    const std::string last = "{\n  \"k\": [\"" + std::string(89, 'x') + "\"]\n}\n";
    EXPECT_EQ(format_json(parse_json(last, "f").value()), last);
}

TEST(JsonValue, FormatsWhatAProgramBuilt) {
    const JsonValue json = json_object({json_member("a \"b\"", json_array({json_integer(-3)})),
                                        json_member("c", "line\nend\x01é")});
    EXPECT_EQ(format_json(json),
              "{\n  \"a \\\"b\\\"\": [-3],\n  \"c\": \"line\\nend\\u0001é\"\n}\n");
    EXPECT_EQ(format_json(parse_json(format_json(json), "f").value()), format_json(json));
}

TEST(JsonValue, QuotesOnlyWhatMustBe) {
    EXPECT_EQ(json_quote("a/\"\\\b\f\n\r\t\x1f\x7f€"), "\"a/\\\"\\\\\\b\\f\\n\\r\\t\\u001f\x7f€\"");
    EXPECT_EQ(json_quote("a\xff\x9b"
                         "b"),
              "\"a\ufffd\ufffdb\"")
        << "JSON is UTF-8, whatever came";
}

}  // namespace
}  // namespace vagus
