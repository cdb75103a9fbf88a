#include "serve/edit/json_patch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "serve/edit/key_order.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

Result<std::string> patch(std::string_view text, std::string_view language, const char* steps) {
    const auto read = read_steps(nlohmann::json::parse(steps));
    if (!read.ok()) return read.error();
    return patched(text, {language, "f.json"}, read.value());
}

std::string patch_text(std::string_view text, const char* steps,
                       std::string_view language = "json") {
    const auto done = patch(text, language, steps);
    return done.ok() ? done.value() : "error: " + done.error().what;
}

// Whatever its form, all but the member meant stays byte for byte.
TEST(JsonPatch, OnlyTheMemberMeantChanges) {
    const std::string odd = "{ \"a\" :1,\n   \"b\":[1,2 ,3],\"c\":{\"d\":  true}}\n\n";
    EXPECT_EQ(patch_text(odd, R"([{"do":"set","at":["a"],"value":7}])"),
              "{ \"a\" :7,\n   \"b\":[1,2 ,3],\"c\":{\"d\":  true}}\n\n");
    EXPECT_EQ(patch_text(odd, R"([{"do":"set","at":["b",1],"value":"x"}])"),
              "{ \"a\" :1,\n   \"b\":[1,\"x\" ,3],\"c\":{\"d\":  true}}\n\n");
    EXPECT_EQ(patch_text(odd, R"([{"do":"set","at":["c","d"],"value":false}])"),
              "{ \"a\" :1,\n   \"b\":[1,2 ,3],\"c\":{\"d\":  false}}\n\n");
    EXPECT_EQ(patch_text(odd, R"([{"do":"remove","at":["b",0]}])"),
              "{ \"a\" :1,\n   \"b\":[2 ,3],\"c\":{\"d\":  true}}\n\n");
    EXPECT_EQ(patch_text(odd, R"([{"do":"remove","at":["a"]}])"),
              "{ \"b\":[1,2 ,3],\"c\":{\"d\":  true}}\n\n");
    EXPECT_EQ(patch_text(odd, R"([{"do":"insert","at":["b",3],"value":4}])"),
              "{ \"a\" :1,\n   \"b\":[1,2 ,3,4],\"c\":{\"d\":  true}}\n\n");
    EXPECT_EQ(patch_text(odd, R"([{"do":"move","at":["b",0],"to":2}])"),
              "{ \"a\" :1,\n   \"b\":[2 ,3,1],\"c\":{\"d\":  true}}\n\n");
}

TEST(JsonPatch, TheSavedFormStaysTheSavedForm) {
    const std::string saved = "{\n  \"a\": { \"b\": [1, 2] },\n  \"c\": 1.50\n}\n";
    ASSERT_EQ(patch_text(saved, "[]"), saved);
    // An object directly in the file has one member a line, as base/json writes it.
    const std::string open = "{\n  \"a\": {\n    \"b\": [1, 2]\n  },\n  \"c\": 1.50\n}\n";
    EXPECT_EQ(patch_text(open, R"([{"do":"set","at":["a","d"],"value":{"x":1,"y":[]}}])"),
              "{\n  \"a\": {\n    \"b\": [1, 2],\n    \"d\": { \"x\": 1, \"y\": [] }\n  },\n"
              "  \"c\": 1.50\n}\n");
    // A line of more than 100 characters is broken, one that fits again is joined.
    const std::string long_text(90, 'x');
    const std::string broken = patch_text(
        open, (R"([{"do":"insert","at":["a","b",1],"value":")" + long_text + R"("}])").c_str());
    EXPECT_EQ(broken, "{\n  \"a\": {\n    \"b\": [\n      1,\n      \"" + long_text +
                          "\",\n      2\n    ]\n  },\n  \"c\": 1.50\n}\n");
    EXPECT_EQ(patch_text(broken, R"([{"do":"remove","at":["a","b",1]}])"), open);
}

TEST(JsonPatch, NewMembersGoWhereTheFormatHasThem) {
    const std::string plan =
        "{\n  \"format\": \"vagus-plan/1\",\n  \"name\": \"P\",\n  \"start\": {\n"
        "    \"actor\": \"a\"\n  },\n  \"actors\": {\n"
        "    \"a\": { \"template\": \"Wait\", \"in\": { \"seconds\": \"1\" }, \"states\": { "
        "\"Done\": \"@terminate\" } }\n  }\n}\n";
    const std::string with_help =
        patch_text(plan, R"([{"do":"set","at":["help"],"value":"Waits."}])", "plan");
    EXPECT_THAT(with_help, HasSubstr("\"name\": \"P\",\n  \"help\": \"Waits.\",\n  \"start\""));
    const std::string with_actor = patch_text(
        plan,
        R"([{"do":"set","at":["actors","b"],"value":{"states":{"Done":"a"},"template":"Log",)"
        R"("in":{"text":"'x'"}}}])",
        "plan");
    EXPECT_THAT(with_actor, HasSubstr(",\n    \"b\": { \"template\": \"Log\", \"in\": { \"text\": "
                                      "\"'x'\" }, \"states\": { \"Done\": \"a\" } }\n  }\n}\n"));
    // A text in another form is not put into this one, but its new member is in order.
    const std::string odd = "{\"format\": \"vagus-world/1\",\"robots\":[]}";
    EXPECT_EQ(patch_text(odd,
                         R"([{"do":"insert","at":["robots",0],"value":{"at":[0,1],"type":)"
                         R"("thymio2","name":"t"}},{"do":"set","at":["size"],"value":[1,1]}])",
                         "world"),
              "{\"format\": \"vagus-world/1\",\"size\": [1, 1],\"robots\":[{ \"name\": \"t\", "
              "\"type\": \"thymio2\", \"at\": [0, 1] }]}");
}

TEST(JsonPatch, OtherIndentationsAndLineEndsAreFollowed) {
    const std::string text(90, 'y');
    const std::string wide = "{\r\n    \"a\": {\r\n        \"b\": 1\r\n    }\r\n}\r\n";
    EXPECT_EQ(patch_text(wide, R"([{"do":"set","at":["a","c"],"value":2}])"),
              "{\r\n    \"a\": {\r\n        \"b\": 1,\r\n        \"c\": 2\r\n    }\r\n}\r\n");
    EXPECT_EQ(patch_text(
                  wide, (R"([{"do":"set","at":["a","c"],"value":[1,")" + text + R"("]}])").c_str()),
              "{\r\n    \"a\": {\r\n        \"b\": 1,\r\n        \"c\": [\r\n          1,\r\n"
              "          \"" +
                  text + "\"\r\n        ]\r\n    }\r\n}\r\n");
}

TEST(JsonPatch, EmptyObjectsAndListsAreFilledAndEmptied) {
    EXPECT_EQ(patch_text("{}\n", R"([{"do":"set","at":["a"],"value":1}])"), "{\n  \"a\": 1\n}\n");
    EXPECT_EQ(patch_text("{\n  \"a\": 1\n}\n", R"([{"do":"remove","at":["a"]}])"), "{}\n");
    EXPECT_EQ(patch_text("[ ]", R"([{"do":"insert","at":[0],"value":[]}])"), "[[]]");
    EXPECT_EQ(patch_text("[1]", R"([{"do":"move","at":[0],"to":0}])"), "[1]");
    EXPECT_EQ(patch_text("{\"a\":1}", R"([{"do":"set","at":[],"value":{"b":2}}])"),
              "{\n  \"b\": 2\n}");
}

TEST(JsonPatch, MembersAndItemsMoveWithTheirForm) {
    EXPECT_EQ(patch_text("{\"a\":1, \"b\" : 2, \"c\":3}", R"([{"do":"move","at":["c"],"to":0}])"),
              "{\"c\":3, \"a\":1, \"b\" : 2}");
}

TEST(JsonPatch, AllStepsOrNone) {
    const std::string text = "{\"a\":[1]}";
    const std::pair<const char*, const char*> wrong[] = {
        {R"([{"do":"set","at":["a",0],"value":2},{"do":"remove","at":["b"]}])",
         "steps[1]: there is no “b”"},
        {R"([{"do":"set","at":["a",1],"value":2}])", "there is no [1]"},
        {R"([{"do":"insert","at":["a",2],"value":2}])", "there is no [2]"},
        {R"([{"do":"insert","at":["a"],"value":2}])", "there is “a” already"},
        {R"([{"do":"set","at":["a","x"],"value":2}])", "is not in an object"},
        {R"([{"do":"set","at":[0],"value":2}])", "is not in a list"},
        {R"([{"do":"set","at":["a",0,"x"],"value":2}])", "is not in an object"},
        {R"([{"do":"move","at":["a",0],"to":1}])", "there are only 1"},
        {R"([{"do":"move","at":["a",0]}])", "“to” is missing"},
        {R"([{"do":"set","at":["a"]}])", "value is missing"},
        {R"([{"do":"remove","at":[]}])", "can only be set"},
        {R"([{"do":"remove","at":[-1]}])", "expected keys and indices"},
        {R"([{"do":"remove","at":[null]}])", "expected keys and indices"},
        {R"([{"do":"remove","at":[1.5]}])", "expected keys and indices"},
    };
    for (const auto& [steps, sentence] : wrong) {
        const auto done = patch(text, "json", steps);
        ASSERT_FALSE(done.ok()) << steps;
        EXPECT_THAT(done.error().what, HasSubstr(sentence)) << steps;
    }
    EXPECT_THAT(patch_text("{\"a\":", R"([])"), HasSubstr("f.json:1:6"));
}

TEST(JsonPatch, AFileIsNotMadeDeeperThanItCanBeRead) {
    nlohmann::json deep = 1;
    for (int i = 0; i < 98; ++i) deep = nlohmann::json::array({deep});
    const auto steps = [&] {
        return nlohmann::json::array({{{"do", "set"}, {"at", {"a"}}, {"value", deep}}}).dump();
    };
    EXPECT_TRUE(patch("{}", "json", steps().c_str()).ok());
    for (int i = 0; i < 3; ++i) deep = nlohmann::json::array({deep});
    EXPECT_FALSE(patch("{}", "json", steps().c_str()).ok());
}

// Supervisors of an actor are asked in the order of the file (P21): a copy has them in that order.
TEST(JsonPatch, AValueThatComesAsTextKeepsTheOrderOfItsKeys) {
    EXPECT_EQ(patch_text("{}", R"([{"do":"set","at":["a"],"text":"{\"z\": 1, \"b\": 1e3}"}])"),
              "{\n  \"a\": {\n    \"z\": 1,\n    \"b\": 1e3\n  }\n}");
    EXPECT_THAT(patch_text("{}", R"([{"do":"set","at":["a"],"text":"{"}])"),
                HasSubstr("steps[0].text:1:2"));
}

TEST(JsonPatch, KeysInQuotesNumbersAndTextsAreKept) {
    const std::string text = "{\"a\\u0041\": 1e3, \"\\\"\": \"\\u00e9\\\\\", \"z\": -0.0}";
    EXPECT_EQ(patch_text(text, R"([{"do":"set","at":["aA"],"value":"\"\n"}])"),
              "{\"a\\u0041\": \"\\\"\\n\", \"\\\"\": \"\\u00e9\\\\\", \"z\": -0.0}");
    EXPECT_EQ(patch_text(text, R"([{"do":"remove","at":["\""]}])"),
              "{\"a\\u0041\": 1e3, \"z\": -0.0}");
}

}  // namespace
}  // namespace vagus::serve
