#include "aesl/node_file.hpp"

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "base/test_places.hpp"

namespace vagus::aesl {
namespace {

constexpr std::string_view kSmall = R"({
  "name": "rover",
  "protocolVersion": 5,
  "bytecodeSize": 600,
  "variablesSize": 200,
  "stackSize": 32,
  "variables": [{ "name": "id", "size": 1 }, { "name": "args", "size": 32 }],
  "localEvents": [{ "name": "tick", "doc": "every 20 ms" }],
  "events": [{ "name": "ping", "size": 0 }, { "name": "old" }],
  "constants": [{ "name": "HUGE", "value": 40000 }],
  "natives": [
    { "name": "math.rand", "doc": "random words", "params": [{ "name": "dest", "size": -1 }] },
    { "name": "sys.nop", "params": [] }
  ]
}
)";

std::string error_of(std::string_view text) {
    const auto parsed = parse_node_file(text, "n.json");
    return parsed.ok() ? "no error" : parsed.error().what;
}

// The small file with one piece of text replaced by another.
std::string error_with(std::string_view from, std::string_view to) {
    std::string text(kSmall);
    const size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return error_of(text.replace(at, from.size(), to));
}

TEST(NodeFile, ReadsTheGoldenNode) {
    const std::string text = read_file(test::testdata("golden/aesl/node.json")).value();
    const NodeFile node = parse_node_file(text, "node.json").value();
    EXPECT_EQ(node.target.name, "goldnode");
    EXPECT_EQ(node.target.protocol_version, 5);
    EXPECT_EQ(node.target.bytecode_size, 600);
    EXPECT_EQ(node.target.variables_size, 200);
    EXPECT_EQ(node.target.stack_size, 32);
    ASSERT_EQ(node.target.variables.size(), 6u);
    EXPECT_EQ(node.target.variables[2].name, "event.args");
    EXPECT_EQ(node.target.variables[2].size, 32);
    ASSERT_EQ(node.target.local_events.size(), 3u);
    ASSERT_EQ(node.target.natives.size(), 32u);
    EXPECT_EQ(node.target.natives[31].parameters[1].size, 0);
    ASSERT_EQ(node.common.events.size(), 5u);
    EXPECT_EQ(node.common.events[2].size, 3);
    EXPECT_EQ(node.common.constants[3].value, 40000);
}

TEST(NodeFile, WritesWhatItReads) {
    EXPECT_EQ(format_node_file(parse_node_file(kSmall, "n.json").value()), kSmall);
}

TEST(NodeFile, AnEventWithoutSizeStaysWithoutSize) {
    EXPECT_EQ(parse_node_file(kSmall, "n").value().common.events[1].size, std::nullopt);
}

TEST(NodeFile, MistakesHavePlaceAndFix) {
    EXPECT_EQ(error_with("\"stackSize\": 32,", ""),
              "n.json:1:1: the node has no \"stackSize\"; add it");
    EXPECT_EQ(error_with("bytecodeSize\": 600", "bytecodeSize\": 65536"),
              "n.json:4:19: \"bytecodeSize\" of the node is 65536; write a whole number from 1 to "
              "65535");
    EXPECT_EQ(error_with("localEvents", "localEvent"),
              "n.json:8:3: the node has the unknown key \"localEvent\"; did you mean "
              "\"localEvents\"?");
    EXPECT_EQ(error_with("\"size\": 32 }", "\"size\": 0 }"),
              "n.json:7:72: \"size\" of variable 2 is 0; write a whole number from 1 to 65535");
    EXPECT_EQ(error_with("\"args\"", "\"id\""),
              "n.json:7:56: variable 2 has the name of an earlier one, \"id\"; rename one of them");
    EXPECT_EQ(error_with("\"dest\", \"size\": -1", "\"dest\", \"size\": 1.5"),
              "n.json:12:88: \"size\" of native function 1, parameter 1 is 1.5; write a whole "
              "number");
    EXPECT_EQ(error_with("\"name\": \"tick\"", "\"name\": \"\""),
              "n.json:8:29: \"name\" of local event 1 is empty; give it a name");
    EXPECT_EQ(error_of("[]"), "n.json:1:1: the node is an array; it must be an object: { … }");
    EXPECT_EQ(error_of("{"),
              "n.json:1:2: this is not JSON: the text ends, but the { of line 1, column 1 is not "
              "closed; add }");
}

TEST(NodeFile, LimitsHoldAtOneMore) {
    EXPECT_EQ(error_with("\"name\": \"ping\", \"size\": 0", "\"name\": \"ping\", \"size\": 258"),
              "no error");
    EXPECT_EQ(error_with("\"name\": \"ping\", \"size\": 0", "\"name\": \"ping\", \"size\": 259"),
              "n.json:9:40: \"size\" of event 1 is 259; write a whole number from 0 to 258");
    EXPECT_EQ(error_with("rover", std::string(kNameBytesMax, 'r')), "no error");
    EXPECT_EQ(error_with("rover", std::string(kNameBytesMax + 1, 'r')),
              "n.json:2:11: \"name\" of the node has 256 bytes; use at most 255");
    EXPECT_EQ(error_with("40000", "2147483648").substr(0, 13), "n.json:10:44:");
}

TEST(NodeFile, AtMost4096NativesAnd32767LocalEvents) {
    const auto many = [](size_t count) {
        std::string list = "[";
        for (size_t i = 0; i < count; ++i)
            list += (i == 0 ? "" : ",") + ("{\"name\":\"n" + std::to_string(i) + "\"}");
        return list + "]";
    };
    constexpr std::string_view kEvents = "[{ \"name\": \"tick\", \"doc\": \"every 20 ms\" }]";
    EXPECT_EQ(error_with(kEvents, many(kLocalEventsMax)), "no error");
    EXPECT_EQ(error_with(kEvents, many(kLocalEventsMax + 1)),
              "n.json:8:18: \"localEvents\" of the node has 32768 entries; a node has at most "
              "32767");
    const std::string natives =
        std::string(kSmall.substr(0, kSmall.find("\"natives\""))) + "\"natives\": ";
    EXPECT_EQ(error_of(natives + many(kNativesMax) + "}"), "no error");
    EXPECT_EQ(error_of(natives + many(kNativesMax + 1) + "}"),
              "n.json:11:14: \"natives\" of the node has 4097 entries; a node has at most 4096");
}

}  // namespace
}  // namespace vagus::aesl
