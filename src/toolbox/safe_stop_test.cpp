#include "toolbox/safe_stop.hpp"

#include <gtest/gtest.h>

#include "toolbox/builtin.hpp"

namespace vagus::toolbox {
namespace {

struct Read {
    SafeStop safe;
    std::string error = "no error";
};

Read read(const std::string& value) {
    const JsonValue json = parse_json("{ \"safe_stop\": " + value + " }", "f").value();
    Complaints complaints;
    JsonObject in(json, "the project", complaints);
    Read result;
    result.safe = read_safe_stop(in, complaints);
    in.finish();
    if (!complaints.empty()) result.error = first_complaint(complaints, "f").what;
    return result;
}

std::string error_of_safe_stop(const std::string& value) {
    return read(value).error;
}

// N entries made by `one(number)`, between `open` and `close`.
template <typename One>
std::string list(size_t n, const std::string& open, const One& one, const std::string& close) {
    std::string text = open;
    for (size_t i = 0; i < n; ++i) text += (i ? ", " : "") + one(i);
    return text + close;
}

std::string quoted(size_t number) {
    return "\"v" + std::to_string(number) + "\"";
}

TEST(SafeStop, ReadsNumbersListsAndWhatMustReadZero) {
    const Read found = read(R"({ "arm": { "set": { "speed": -3, "lamps": [1, 2] } },
                                 "drive": { "read": ["wheel"], "x": 1 }, "idle": {} })");
    EXPECT_EQ(found.error, "no error");
    const SafeStop expected = {{"arm", {{{"speed", {-3}}, {"lamps", {1, 2}}}, {}}},
                               {"drive", {{}, {"wheel"}}},
                               {"idle", {}}};
    EXPECT_EQ(found.safe, expected);
}

TEST(SafeStop, NamesWhatIsWrongAndWhere) {
    EXPECT_EQ(error_of_safe_stop("[]"),
              "f:1:16: \"safe_stop\" of the project is an array; write an object");
    EXPECT_EQ(error_of_safe_stop(R"({ "a": { "sett": {} } })"),
              "f:1:25: \"a\" in \"safe_stop\" has the unknown key \"sett\"; did you mean \"set\"?");
    EXPECT_EQ(error_of_safe_stop(R"({ "a": { "set": { "v": 1.5 } } })"),
              "f:1:39: the value of \"v\" in \"safe_stop\" is 1.5; write a whole number from "
              "-32768 to 32767, or a list of them for an array");
    EXPECT_EQ(error_of_safe_stop(R"({ "a": { "set": { "v": [1, null] } } })"),
              "f:1:43: the value of \"v\" in \"safe_stop\" is null; write a whole number from "
              "-32768 to 32767, or a list of them for an array");
    EXPECT_EQ(error_of_safe_stop(R"({ "a": { "set": { "v": [] } } })"),
              "f:1:39: \"v\" in \"safe_stop\": expected 1 to 64 values, found none; write the "
              "value to set");
    EXPECT_EQ(error_of_safe_stop(R"({ "a": { "set": { "v": 1, "v": 2 } } })"),
              "f:1:42: \"set\" of \"a\" in \"safe_stop\" has the variable \"v\" a second time; "
              "remove one");
    EXPECT_EQ(error_of_safe_stop(R"({ "a": { "read": ["v", "v"] } })"),
              "f:1:39: \"read\" of \"a\" in \"safe_stop\" names \"v\" twice; keep one of them");
    EXPECT_EQ(
        error_of_safe_stop(R"({ "a": { "read": [1] } })"),
        "f:1:34: \"read\" of \"a\" in \"safe_stop\" holds names of variables in quotes, not a "
        "whole number");
    EXPECT_EQ(error_of_safe_stop(R"({ "a": {}, "a": {} })"),
              "f:1:27: \"safe_stop\" has the node \"a\" a second time; remove one");
    EXPECT_EQ(error_of_safe_stop(R"({ "": {} })"),
              "f:1:18: a name in \"safe_stop\" has 0 bytes; expected the name of a node, 1 to 255 "
              "bytes");
}

TEST(SafeStop, ValuesAreWords) {
    EXPECT_EQ(error_of_safe_stop(R"({ "a": { "set": { "v": [-32768, 32767] } } })"), "no error");
    EXPECT_NE(error_of_safe_stop(R"({ "a": { "set": { "v": 32768 } } })"), "no error");
    EXPECT_NE(error_of_safe_stop(R"({ "a": { "set": { "v": -32769 } } })"), "no error");
}

TEST(SafeStop, EachListHasItsLimit) {
    const auto node = [](size_t i) { return quoted(i) + ": {}"; };
    EXPECT_EQ(error_of_safe_stop(list(kSafeStopNodesMax, "{", node, "}")), "no error");
    EXPECT_EQ(error_of_safe_stop(list(kSafeStopNodesMax + 1, "{", node, "}")),
              "f:1:16: \"safe_stop\": expected at most 64 nodes, found 65; remove some");
    const auto set = [](size_t i) { return quoted(i) + ": 0"; };
    EXPECT_EQ(error_of_safe_stop(list(kSafeStopVariablesMax, "{\"a\": {\"set\": {", set, "}}}")),
              "no error");
    EXPECT_EQ(
        error_of_safe_stop(list(kSafeStopVariablesMax + 1, "{\"a\": {\"set\": {", set, "}}}")),
        "f:1:30: \"set\" of \"a\" in \"safe_stop\": expected at most 64 variables, found 65; "
        "remove some");
    EXPECT_EQ(
        error_of_safe_stop(list(kSafeStopVariablesMax, "{\"a\": {\"read\": [", quoted, "]}}")),
        "no error");
    EXPECT_EQ(
        error_of_safe_stop(list(kSafeStopVariablesMax + 1, "{\"a\": {\"read\": [", quoted, "]}}")),
        "f:1:31: \"read\" of \"a\" in \"safe_stop\": expected at most 64 variables, found 65; "
        "remove some");
    const auto zero = [](size_t) { return std::string("0"); };
    EXPECT_EQ(
        error_of_safe_stop(list(kSafeStopValuesMax, "{\"a\": {\"set\": {\"v\": [", zero, "]}}}")),
        "no error");
    EXPECT_EQ(error_of_safe_stop(
                  list(kSafeStopValuesMax + 1, "{\"a\": {\"set\": {\"v\": [", zero, "]}}}")),
              "f:1:36: \"v\" in \"safe_stop\": expected 1 to 64 values, found 65; remove some");
    const std::string longest(kSafeStopNameBytesMax, 'n');
    EXPECT_EQ(error_of_safe_stop("{\"" + longest + "\": {}}"), "no error");
    EXPECT_NE(error_of_safe_stop("{\"" + longest + "n\": {}}"), "no error");
}

TEST(SafeStop, AStrongerEntryReplacesThatOfItsNode) {
    SafeStop safe = {{"a", {{{"v", {0}}}, {"w"}}}, {"b", {}}};
    overlay(safe, {{"a", {{}, {"u"}}}});
    EXPECT_EQ(safe, (SafeStop{{"a", {{}, {"u"}}}, {"b", {}}}));
}

// docs/spec/aseba-wire-and-vm.md, 5.2 and 5.3; docs/carbot.md.
TEST(SafeStop, ThymioEPuckAndCarbotComeWithTheProgram) {
    const SafeStop shipped = builtin_safe_stop();
    const SafeStopNode thymio = {{{"motor.left.target", {0}}, {"motor.right.target", {0}}}, {}};
    const SafeStopNode epuck = {{{"speed.left", {0}}, {"speed.right", {0}}}, {}};
    EXPECT_EQ(shipped.at("thymio-II"), thymio);
    for (char digit = '0'; digit <= '9'; ++digit) {
        EXPECT_EQ(shipped.at(std::string("e-puck") + digit), epuck) << digit;
    }
    EXPECT_EQ(shipped.at("drive"), (SafeStopNode{{}, {"wheel.front.speed", "wheel.rear.speed"}}));
}

}  // namespace
}  // namespace vagus::toolbox
