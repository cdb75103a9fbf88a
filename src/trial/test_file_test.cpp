#include "trial/test_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vagus::trial {
namespace {

constexpr std::string_view kWhole = R"({
  "format": "vagus-test/1",
  "help": "h",
  "plan": "a.plan.json", "world": "b.world.json", "robot": "carbot",
  "toolboxes": ["light.toolbox.json"],
  "seeds": [3, 20], "max_time": 130,
  "set": { "walldist": 30, "fast": true, "name": "x" },
  "starts": { "robot": "carbot", "within": [[3, 0.6], [0.6, 2]], "angle": [-30, 30] },
  "expect": [
    { "order": ["a", "b/c"] },
    { "within": 40, "eventually": "actor == 'a'", "help": "soon" },
    { "always": "contact < 2" },
    { "never": "event == 'e'" },
    { "ends": "Interrupted", "by": "escape" } ] })";

TEST(TestFile, IsReadWithAllItsKeys) {
    const auto read = read_test(kWhole, "folder/t.test.json");
    ASSERT_TRUE(read.ok()) << read.error().what;
    const TestFile& test = read.value();
    EXPECT_EQ(test.plan, "folder/a.plan.json");
    EXPECT_EQ(test.world, "folder/b.world.json");
    EXPECT_EQ(test.toolboxes, std::vector<std::string>{"folder/light.toolbox.json"});
    EXPECT_EQ(test.robot, "carbot");
    EXPECT_EQ(test.seeds.first, 3u);
    EXPECT_EQ(test.seeds.last, 20u);
    EXPECT_EQ(test.max_time, 130);
    EXPECT_EQ(test.set, (std::vector<std::string>{"walldist=30", "fast=true", "name=x"}));
    ASSERT_TRUE(test.starts);
    EXPECT_EQ(test.starts->low, (sim::Point{0.6, 0.6}));
    EXPECT_EQ(test.starts->high, (sim::Point{3, 2}));
    EXPECT_EQ(test.starts->angle_low, -30);
    ASSERT_EQ(test.expect.size(), 5u);
    EXPECT_EQ(text_of(test.expect[0]), "order a, b/c");
    EXPECT_EQ(text_of(test.expect[1]), "eventually \"actor == 'a'\" within 40 s");
    EXPECT_EQ(text_of(test.expect[2]), "always \"contact < 2\"");
    EXPECT_EQ(text_of(test.expect[3]), "never \"event == 'e'\"");
    EXPECT_EQ(text_of(test.expect[4]), "ends Interrupted by escape");
    EXPECT_EQ(test.expect[4].at.line, 14);
}

// ---- without a plan ----

std::string error_of_world_alone(std::string_view members,
                                 std::string_view expect = R"({"ends":"MaxTime"})") {
    const auto read = read_test(
        fmt::format(R"({{"format":"vagus-test/1",{}"expect":[{}]}})", members, expect), "t");
    return read.ok() ? "" : read.error().what;
}

TEST(TestFile, AWorldAloneIsEnough) {
    EXPECT_EQ(error_of_world_alone(R"("world":"b.world.json","scripts":["a.aesl"],)",
                                   R"({"always":"contact == 0"},{"ends":"MaxTime"})"),
              "");
    EXPECT_EQ(error_of_world_alone(""),
              "t:1:1: the test has no \"plan\" and no \"world\"; add one of them, or both");
    EXPECT_EQ(error_of_world_alone(R"("plann":"a.plan.json",)"),
              "t:1:26: the test has the unknown key \"plann\"; did you mean \"plan\"?");
}

TEST(TestFile, WhatIsOfAPlanIsRefusedWithoutOne) {
    const auto key = [](std::string_view member) {
        return error_of_world_alone(fmt::format(R"("world":"w",{},)", member));
    };
    EXPECT_EQ(
        key(R"("set":{"a":1})"),
        "t:1:44: \"set\" of the test gives values to variables of a plan, and the test has no "
        "\"plan\"; add one, or remove \"set\"");
    EXPECT_EQ(key(R"("answers":{})"),
              "t:1:48: \"answers\" of the test says what actors of a plan answer, and the test has "
              "no \"plan\"; add one, or remove \"answers\"");
    EXPECT_EQ(key(R"("toolboxes":["x"])"),
              "t:1:50: \"toolboxes\" of the test names templates of a plan, and the test has no "
              "\"plan\"; add one, or remove \"toolboxes\"");
    const auto expected = [](std::string_view one) {
        return error_of_world_alone(R"("world":"w",)", one);
    };
    EXPECT_EQ(expected(R"({"order":["a"]})"),
              "t:1:57: \"order\" of expectation 1 names actors of a plan, and the test has no "
              "\"plan\"; add one, or remove \"order\"");
    EXPECT_EQ(expected(R"({"ends":"OK"})"),
              "t:1:56: \"ends\" of expectation 1: without a \"plan\" a run ends only when its "
              "\"max_time\" is over; write \"MaxTime\"");
    EXPECT_EQ(expected(R"({"ends":"MaxTime","by":"a"})"),
              "t:1:71: \"by\" of expectation 1 names a supervisor of a plan, and the test has no "
              "\"plan\"; add one, or remove \"by\"");
    EXPECT_EQ(
        expected(R"({"never":"actor == 'a'"})"),
        "t:1:57: \"never\" of expectation 1: \"actor\" is of a plan, and there is none; write "
        "a signal of the world, as contact, event or node(\"NODE\", \"NAME\")");
}

TEST(TestFile, ScriptsAreForAWorldWithoutAPlan) {
    EXPECT_EQ(error_of_world_alone(R"("plan":"p","world":"w","scripts":["a.aesl"],)"),
              "t:1:59: \"scripts\" of the test are for a test without a \"plan\"; beside a plan "
              "robots run the scripts that the \"world\" names: name them there");
    EXPECT_EQ(error_of_world_alone(R"("world":"w","scripts":[7],)"),
              "t:1:49: expected the path of a script, as \"explore.aesl\"");
}

// A test with these members beside the ones that it needs, and this list of expectations.
std::string error_of(std::string_view members, std::string_view expect = R"({"ends":"OK"})") {
    const auto read =
        read_test(fmt::format(R"({{"format":"vagus-test/1","plan":"a.plan.json",{}"expect":[{}]}})",
                              members, expect),
                  "t");
    return read.ok() ? "" : read.error().what;
}

TEST(TestFile, EveryMistakeHasItsPlaceAndItsFix) {
    EXPECT_EQ(error_of(""), "");
    EXPECT_EQ(error_of("", ""),
              "t:1:56: \"expect\" of the test is empty: nothing could fail; write what is "
              "expected, as { \"ends\": \"OK\" }");
    EXPECT_EQ(error_of("\"sedes\":[1,2],"),
              "t:1:47: the test has the unknown key \"sedes\"; did you mean \"seeds\"?");
    EXPECT_EQ(error_of("", R"({"ends":"OK","by":"escape"})"),
              "t:1:75: \"by\" of expectation 1: a plan that a supervisor ends is never OK; expect "
              "Interrupted, or leave \"by\" out");
    EXPECT_EQ(error_of("\"seeds\":[2],"),
              "t:1:55: \"seeds\" of the test: write the first and the last, as [1, 20]");
    EXPECT_EQ(error_of("\"seeds\":[2,1],"),
              "t:1:55: \"seeds\" of the test: expected the smaller number first, found 2 and 1");
    EXPECT_EQ(parse_seeds("0..18446744073709551615").error().what,
              "--seeds 0..18446744073709551615: expected seeds up to 9223372036854775807, found "
              "18446744073709551615");
    EXPECT_EQ(error_of("\"seeds\":[1,10000],"), "");
    EXPECT_EQ(error_of("\"seeds\":[1,10001],"),
              "t:1:55: \"seeds\" of the test: expected at most 10000 of them, found 10001");
    EXPECT_EQ(error_of("\"max_time\":0,"),
              "t:1:58: \"max_time\" of the test is 0; write a number from 0.001 to 86400");
    EXPECT_EQ(error_of("\"set\":{\"a\":[]},"),
              "t:1:58: \"set\" of the test: the value of \"a\" is an array; write a number, a "
              "text, true or false");
    EXPECT_EQ(error_of("\"starts\":{\"robot\":\"r\",\"within\":[1,2],\"angle\":\"any\"},"),
              "t:1:78: \"within\" of \"starts\": write two opposite corners in metres, as [[0.6, "
              "0.6], [3, 2]]");
    EXPECT_EQ(error_of("\"starts\":{\"robot\":\"r\",\"within\":[[1,2],[1,2]],\"angle\":\"all\"},"),
              "t:1:100: \"angle\" of \"starts\": write degrees, as 90, two between which it is "
              "drawn, as [-30, 30], or \"any\"");
    EXPECT_EQ(error_of("", "{}"),
              "t:1:57: expectation 1 expects nothing; write \"order\", \"eventually\", \"always\", "
              "\"never\" or \"ends\"");
    EXPECT_EQ(error_of("", "{\"ends\":\"ok\"}"),
              "t:1:65: \"ends\" of expectation 1 is \"ok\"; write one of OK, "
              "Interrupted, Error and MaxTime");
    EXPECT_EQ(error_of("", "{\"order\":[]}"),
              "t:1:66: \"order\" of expectation 1: write 1 to 10000 names of actors, found 0");
    EXPECT_EQ(error_of("", "{\"always\":\"1 +\"}").substr(0, 35),
              "t:1:67: \"always\" of expectation 1: ");
    EXPECT_EQ(error_of("", "{\"always\":\"1\",\"never\":\"0\"}"),
              "t:1:71: expectation 1 has the unknown key \"never\"; remove it, or use one of help "
              "and always");
}

TEST(TestFile, APlanIsNoTest) {
    const auto read = read_test(R"({"format":"vagus-plan/1"})", "t");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(
        read.error().what,
        "t:1:11: this is a plan file (vagus-plan/1); a test file (vagus-test/1) was expected");
}

TEST(TestFile, MoreExpectationsThanTheLimitAreRefused) {
    std::string list = R"({"ends":"OK"})";
    for (size_t i = 1; i < kExpectationsMax; ++i) list += R"(,{"ends":"OK"})";
    EXPECT_EQ(error_of("", list), "");
    EXPECT_EQ(error_of("", list + R"(,{"ends":"OK"})"),
              "t:1:56: \"expect\" of the test has 1001 entries; write at most 1000");
}

TEST(Seeds, AreARangeOrOne) {
    EXPECT_EQ(parse_seeds("3..7").value().last, 7u);
    EXPECT_EQ(parse_seeds("5").value().first, 5u);
    EXPECT_EQ(parse_seeds("5").value().last, 5u);
    for (const char* wrong : {"", "..", "1..", "a", "1-2", "2..1", "0..10000"}) {
        EXPECT_FALSE(parse_seeds(wrong).ok()) << wrong;
    }
}

}  // namespace
}  // namespace vagus::trial
