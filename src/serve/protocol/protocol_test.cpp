#include "serve/protocol/protocol.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "base/test_places.hpp"
#include "serve/json.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

std::string refused(const std::string& message) {
    const auto read = Protocol::get().read(message);
    const auto* refusal = std::get_if<Refusal>(&read);
    return refusal ? refusal->problem.code + " " + refusal->problem.what : "accepted";
}

TEST(Protocol, TheListThatIsBuiltInCanBeRead) {
    const Protocol& protocol = Protocol::get();
    ASSERT_NE(protocol.command("stop"), nullptr);
    EXPECT_EQ(protocol.command("stop")->may, May::Look);
    EXPECT_EQ(protocol.command("node.run")->may, May::Driver);
    EXPECT_EQ(protocol.topic("poses")->number, 3);
}

TEST(Protocol, AGoodCommand) {
    const auto read = Protocol::get().read(
        R"({"id":7,"do":"variable.set","in":{"node":1,"name":"x","first":0,"values":[1,-32768]}})");
    ASSERT_TRUE(std::holds_alternative<Request>(read));
    EXPECT_EQ(std::get<Request>(read).id, 7u);
    EXPECT_EQ(std::get<Request>(read).in["values"][1], -32768);
}

TEST(Protocol, EachMistakeIsNamedWithItsPlace) {
    EXPECT_THAT(refused("nonsense"), HasSubstr("expected a JSON object"));
    EXPECT_THAT(refused("[]"), HasSubstr("expected a JSON object"));
    EXPECT_THAT(refused(R"({"do":"stop"})"), HasSubstr("id: expected"));
    EXPECT_THAT(refused(R"({"id":-1,"do":"stop"})"), HasSubstr("id: expected"));
    EXPECT_THAT(refused(R"({"id":1})"), HasSubstr("do: expected"));
    EXPECT_THAT(refused(R"({"id":1,"do":"stopp"})"), HasSubstr("did you mean “stop”"));
    EXPECT_THAT(refused(R"({"id":1,"do":"stop","x":1})"), HasSubstr("x: not known"));
    EXPECT_THAT(refused(R"({"id":1,"do":"node.run","in":{}})"), HasSubstr("in.node is missing"));
    EXPECT_THAT(refused(R"({"id":1,"do":"node.run","in":{"node":65535}})"),
                HasSubstr("in.node: 65535 is out of range; expected 0 to 65534"));
    EXPECT_THAT(refused(R"({"id":1,"do":"node.run","in":{"node":1.5}})"),
                HasSubstr("in.node: expected a whole number, found a number"));
    EXPECT_THAT(refused(R"({"id":1,"do":"node.run","in":{"node":1,"nod":2}})"),
                HasSubstr("in.nod is not known; did you mean “node”?"));
    EXPECT_THAT(refused(R"({"id":1,"do":"event.send","in":{"name":"x","args":[0,40000]}})"),
                HasSubstr("in.args[1]: 40000 is out of range"));
    EXPECT_THAT(refused(R"({"id":1,"do":"doc.keep","in":{"doc":"a","which":"yours"}})"),
                HasSubstr("expected mine, disk and both"));
    EXPECT_THAT(refused(R"({"id":1,"do":"doc.open","in":{"doc":"a\u0000b"}})"),
                HasSubstr("a control character"));
}

TEST(Protocol, LimitsHoldJustPastThem) {
    const size_t depth = Protocol::get().limit("message_depth");
    const auto nested = [](size_t deep) {
        return R"({"id":1,"do":"state.put","in":{"key":"k","value":)" + std::string(deep - 2, '[') +
               std::string(deep - 2, ']') + "}}";
    };
    EXPECT_EQ(refused(nested(depth)), "accepted");
    EXPECT_THAT(refused(nested(depth + 1)), HasSubstr("nests deeper than 32"));
    const std::string brackets = R"({"id":1,"do":"state.put","in":{"key":"k","value":")" +
                                 std::string(depth + 5, '[') + "\\\"" + R"("}})";
    EXPECT_EQ(refused(brackets), "accepted");  // in a string they are letters
    EXPECT_THAT(refused(std::string(Protocol::get().limit("message_bytes") + 1, ' ')),
                HasSubstr("at most 4194304 are allowed"));
    const std::string name(129, 'a');
    EXPECT_THAT(refused(R"({"id":1,"do":"event.send","in":{"args":[],"name":")" + name + "\"}}"),
                HasSubstr("129 bytes; at most 128"));
}

TEST(Protocol, ThePageNamesEveryCommand) {
    const std::string page = Protocol::get().page();
    EXPECT_THAT(page, HasSubstr("### node.run"));
    EXPECT_THAT(page, HasSubstr("list of int -32768 to 32767, 600 at most"));
}

TEST(ProtocolType, MistakesInTheListAreFound) {
    EXPECT_FALSE(parse_type("int(1..").ok());
    EXPECT_FALSE(parse_type("strange").ok());
    EXPECT_FALSE(parse_type("[int]").ok());
    EXPECT_FALSE(parse_type("bool bool").ok());
    EXPECT_FALSE(Protocol::parse("{").ok());
    EXPECT_FALSE(Protocol::parse(R"({"help":[],"limits":{},"types":{"A":{"is":"Missing"}},
                                     "commands":{},"topics":{}})")
                     .ok());
}

TEST(Protocol, ThePageOfDocumentationIsCurrent) {
    const auto page = read_file(test::docs("protocol.md"));
    ASSERT_TRUE(page.ok()) << page.error().what;
    EXPECT_TRUE(page.value() == Protocol::get().page())
        << "run: build/release/bin/protocol_page > docs/protocol.md";
}

}  // namespace
}  // namespace vagus::serve
