#include "fleet/message.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "base/file.hpp"
#include "base/test_places.hpp"
#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

const char* const kEventTopic = "vagus/1/lab/robot/r1/event/alarm";

std::string why(std::string_view topic, std::string_view payload) {
    const auto heard = read("lab", topic, payload);
    return heard.ok() ? "" : heard.error().what;
}

const keeper::Task kTask{
    "pick", "t1", {12, 3}, "{ \"shelf\": 4 }", keeper::Work::Leased, {"r1", {12, 4}, 1500ms}, ""};

// How each request looks as JSON; worked out from docs/fleet-messages.md.
TEST(Message, QuestionsToTheKeeperHaveATopicEach) {
    const std::pair<keeper::Request, std::pair<const char*, const char*>> all[] = {
        {keeper::Give{"pick", "t1", "[4]"},
         {"give", R"("queue": "pick", "id": "t1", "data": [4])"}},
        {keeper::Take{"pick", 1500ms}, {"take", R"("queue": "pick", "length": 1500)"}},
        {keeper::ClaimName{"aisle", 2s}, {"claim", R"("name": "aisle", "length": 2000)"}},
        {keeper::Renew{{12, 4}}, {"renew", R"("term": "12.4")"}},
        {keeper::Finish{{12, 4}, "true"}, {"finish", R"("term": "12.4", "result": true)"}},
        {keeper::Release{{12, 4}}, {"release", R"("term": "12.4")"}},
        {keeper::Write{"map", {12, 6}, "1"},
         {"write", R"("key": "map", "seen": "12.6", "value": 1)"}},
    };
    for (const auto& [request, looks] : all) {
        const std::string topic = text_of("lab", topic_of("r1", request));
        EXPECT_EQ(topic, std::string("vagus/1/lab/robot/r1/ask/") + looks.first);
        const std::string payload = payload_of(Question{7, 3, request});
        EXPECT_EQ(payload, fmt::format(R"({{ "number": 3, "epoch": 7, {} }})", looks.second));
        const auto heard = read("lab", topic, payload);
        ASSERT_TRUE(heard.ok()) << heard.error().what;
        EXPECT_EQ(payload_of(heard.value().message), payload);
    }
}

TEST(Message, WhatTheKeeperCannotReadIsNamed) {
    const std::string take = "vagus/1/lab/robot/r1/ask/take";
    const auto with = [](const char* rest) {
        return fmt::format(R"({{ "number": 3, "epoch": 7, "queue": "pick", {} }})", rest);
    };
    EXPECT_EQ(why(take, with(R"("length": 60000)")), "");
    EXPECT_EQ(why(take, with(R"("length": 60001)")),
              take + ": \"length\": expected a whole number from 0 to 60000, found a whole number");
    EXPECT_EQ(why("vagus/1/lab/robot/r1/ask/renew", with(R"("term": "12")")),
              "vagus/1/lab/robot/r1/ask/renew: \"term\": expected a term: EPOCH.NUMBER, found a "
              "string");
    EXPECT_EQ(why("vagus/1/lab/keeper/answer/r1",
                  R"({ "number": 3, "epoch": 7, "outcome": "done", "keeper": 2, "record": {} })"),
              "vagus/1/lab/keeper/answer/r1: \"topic\": expected that of a task or of a shared "
              "value");
}

TEST(Message, EveryKindIsReadAsItIsWritten) {
    const std::pair<Topic, Message> all[] = {
        {{.kind = Kind::Connection, .robot = "r1"}, Connection{"online", "i1", 7}},
        {{.kind = Kind::Description, .robot = "r1"},
         Description{"Alarm",
                     "0.1.0",
                     "a.plan.json",
                     "http://r1/",
                     {"red"},
                     {"thymio-II"},
                     {"alarm"},
                     {"alarm"}}},
        {{.kind = Kind::State, .robot = "r1"},
         State{3, 7, 12'000, "running", 11'000, "drive", {"thymio-II is gone"}, 2}},
        {{.kind = Kind::Variable, .robot = "r1", .name = "x", .node = "drive"},
         Variable{5, 7, {-1, 2}}},
        {{.kind = Kind::Event, .robot = "r1", .name = "alarm"}, Event{4, 7, {"red"}, {-32768}}},
        {{.kind = Kind::Ask, .robot = "r1", .name = "name"}, Ask{"i2"}},
        {{.kind = Kind::Answer, .robot = "r1", .name = "op"},
         Answer{"c1", true, "", "", {"thymio-II"}}},
        {{.kind = Kind::Command, .robot = "r1", .name = "set"},
         Command{.verb = "set",
                 .id = "c1",
                 .reply = "op",
                 .epoch = 7,
                 .deadline = 15'000,
                 .node = "drive",
                 .name = "speed",
                 .values = {3}}},
        {{.kind = Kind::Command, .name = "stop"},
         Command{.verb = "stop", .id = "c1", .reply = "op"}},
        {{.kind = Kind::Want, .robot = "r1"}, Want{7, "ab", "https://desk:8443/x", true}},
        {{.kind = Kind::Version, .robot = "r1"}, Version{7, "ab", "refused", "it has mistakes"}},
        {{.kind = Kind::Beat}, keeper::Beat{12, "k1", 3}},
        {{.kind = Kind::Task, .name = "t1", .queue = "pick"}, keeper::Record(kTask)},
        {{.kind = Kind::Shared, .name = "aisle"},
         keeper::Record(keeper::Claim{"aisle", {"", {12, 5}, 10s}})},
        {{.kind = Kind::Shared, .name = "map"},
         keeper::Record(keeper::Shared{"map", {12, 6}, "[1, 2]"})},
        {{.kind = Kind::Reply, .robot = "r1"},
         Reply{7, 4, {keeper::Outcome::Done, "", 12, keeper::Record(kTask)}}},
        {{.kind = Kind::Reply, .robot = "r1"},
         Reply{7, 5, {keeper::Outcome::Nothing, "no task waits in pick", 12, {}}}},
    };
    for (const auto& [topic, message] : all) {
        const std::string text = text_of("lab", topic);
        const auto heard = read("lab", text, payload_of(message, "lab"));
        ASSERT_TRUE(heard.ok()) << heard.error().what;
        EXPECT_TRUE(heard.value().message == message) << text << payload_of(message);
    }
}

TEST(Message, AnEventLooksAsDocumented) {
    EXPECT_EQ(payload_of(Event{4, 7, {"red"}, {1, -2}}),
              R"({ "number": 4, "epoch": 7, "groups": ["red"], "args": [1, -2] })");
}

TEST(Message, WhatALaterVersionAddsIsPassedOver) {
    EXPECT_EQ(why(kEventTopic, R"({"number":1,"epoch":1,"groups":[],"args":[],"new":{}})"), "");
}

TEST(Message, WhatIsWrongIsSaidWithItsTopic) {
    const std::string topic = kEventTopic;
    EXPECT_EQ(why(topic, R"({"number":1,"epoch":1,"groups":[]})"),
              topic + ": \"args\" is missing: expected 0 to 258 whole numbers of 16 bits");
    EXPECT_EQ(why(topic, R"({"number":0,"epoch":1,"groups":[],"args":[]})"),
              topic +
                  ": \"number\": expected a whole number from 1 to 9007199254740991, "
                  "found a whole number");
    EXPECT_NE(why(topic, R"({"number":1,"epoch":1,"groups":["a","\u0000"],"args":[]})"), "");
    EXPECT_NE(why(topic, R"({"number":1,"epoch":1,"groups":[],"args":[32768]})"), "");
    EXPECT_NE(why(topic, R"({"number":1.5,"epoch":1,"groups":[],"args":[]})"), "");
    EXPECT_NE(why(topic, "[]"), "");
    EXPECT_NE(why(topic, "{"), "");
    EXPECT_NE(why(topic, ""), "");
    EXPECT_NE(why("vagus/1/lab/cmd/r1/explode", R"({"id":"a","reply":"b"})"), "");
    EXPECT_NE(why("vagus/1/lab/cmd/r1/set", R"({"id":"a","reply":"b"})"), "");
    EXPECT_NE(why("vagus/1/lab/cmd/r1/stop", R"({"id":"a/b\n","reply":"b"})"), "");
}

TEST(Message, SizesHaveLimits) {
    const auto event = [](size_t words) {
        return payload_of(Event{1, 1, {}, std::vector<int16_t>(words, 1)});
    };
    EXPECT_EQ(why(kEventTopic, event(kWordsMax)), "");
    EXPECT_NE(why(kEventTopic, event(kWordsMax + 1)), "");
    std::string payload = event(0);
    payload.resize(kPayloadBytesMax, ' ');
    EXPECT_EQ(why(kEventTopic, payload), "");
    EXPECT_NE(why(kEventTopic, payload + " "), "");
    const auto groups = [](size_t count) {
        return payload_of(Event{1, 1, std::vector<std::string>(count, "g"), {}});
    };
    EXPECT_EQ(why(kEventTopic, groups(kGroupsMax)), "");
    EXPECT_NE(why(kEventTopic, groups(kGroupsMax + 1)), "");
    State state;
    state.number = 1;
    const std::string topic = "vagus/1/lab/robot/r1/state";
    state.problems.assign(kProblemsMax, std::string(kLineBytesMax, 'a'));
    EXPECT_EQ(why(topic, payload_of(state)), "");
    state.problems.front() += "a";
    EXPECT_NE(why(topic, payload_of(state)), "");
    state.problems.assign(kProblemsMax + 1, "a");
    EXPECT_NE(why(topic, payload_of(state)), "");
}

TEST(Message, ThePageIsThatOfTheList) {
    const auto page = read_file(test::docs("fleet-messages.md"));
    ASSERT_TRUE(page.ok()) << page.error().what;
    EXPECT_EQ(page.value(), page_of_messages())
        << "build/release/bin/fleet_page > docs/fleet-messages.md";
}

}  // namespace
}  // namespace vagus::fleet
