#include "fleet/project_part.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

struct ReadPart {
    ProjectPart part;
    Complaints complaints;
};

ReadPart read_part(const std::string& text) {
    ReadPart result;
    const JsonValue json = parse_json(text, "f").value();
    JsonObject in(json, "the project", result.complaints);
    result.part = read_project_part(in, result.complaints);
    return result;
}

std::string list(size_t count, const std::string& before = "e", const std::string& behind = "") {
    std::string text;
    for (size_t i = 0; i < count; ++i) {
        text += fmt::format("{}\"{}{}{}\"", i == 0 ? "" : ", ", before, i, behind);
    }
    return "[" + text + "]";
}

TEST(ProjectPart, HasWhatTheFileSays) {
    const ReadPart all =
        read_part(R"({"fleet": {"name": "lab", "groups": ["red"], "send": ["alarm"],
        "hear": ["go", {"event": "alarm", "from": "red"}], "tell": ["drive.odometry.x"],
        "broker_lost": "continue", "x": 1}})");
    EXPECT_TRUE(all.complaints.empty());
    EXPECT_EQ(all.part, (ProjectPart{.name = "lab",
                                     .groups = {"red"},
                                     .send = {"alarm"},
                                     .hear = {{"go", ""}, {"alarm", "red"}},
                                     .tell = {{"drive", "odometry.x"}},
                                     .broker_lost = BrokerLost::Continue}));
    EXPECT_EQ(read_part("{}").part, ProjectPart{});
    EXPECT_EQ(read_part(R"({"fleet": {}})").part.broker_lost, BrokerLost::Stop);
}

TEST(ProjectPart, ItsConditionOfBeingWellIsAFormula) {
    const ReadPart all =
        read_part(R"x({"fleet": {"healthy": {"condition": "a > node('d', 'b')", "for": 5}}})x");
    EXPECT_TRUE(all.complaints.empty());
    EXPECT_EQ(all.part.healthy, (Healthy{"a > node('d', 'b')", 5s}));
    EXPECT_EQ(read_part(R"({"fleet": {"healthy": {"condition": "a"}}})").part.healthy,
              (Healthy{"a", 3s}));
    EXPECT_EQ(read_part(R"({"fleet": {}})").part.healthy, std::nullopt);
}

std::string complaint_of(const std::string& healthy) {
    const ReadPart all = read_part(R"({"fleet": {"healthy": )" + healthy + "}}");
    return all.complaints.empty() ? "" : first_complaint(all.complaints, "f").what;
}

TEST(ProjectPart, WhatIsWrongWithTheConditionHasItsPlace) {
    EXPECT_EQ(complaint_of(R"({"condition": "a", "for": 30})"), "");
    EXPECT_EQ(complaint_of(R"({"condition": "a", "for": 30.5})"),
              "f:1:49: \"for\" of \"healthy\" is 30.5; write a number from 0 to 30");
    EXPECT_EQ(complaint_of(R"({"condition": "a >"})").substr(0, 40),
              "f:1:37: \"condition\" of \"healthy\": expect");
    EXPECT_EQ(complaint_of(R"({"condition": "node(a, b) > 1"})"),
              "f:1:37: \"condition\" of \"healthy\": expected two texts, as node(\"drive\", "
              "\"token\"), behind node");
    EXPECT_NE(complaint_of("{}"), "");
    EXPECT_NE(complaint_of("3"), "");
    EXPECT_NE(complaint_of(R"({"condition": "a", "four": 3})").find("did you mean"),
              std::string::npos);
    const auto long_one = [](size_t bytes) {
        return R"({"condition": ")" + std::string(bytes, 'a') + "\"}";
    };
    EXPECT_EQ(complaint_of(long_one(kConditionBytesMax)), "");
    EXPECT_EQ(
        complaint_of(long_one(kConditionBytesMax + 1)),
        "f:1:37: \"condition\" of \"healthy\": expected at most 500 bytes, found 501; write a "
        "shorter one");
}

TEST(ProjectPart, WhatIsWrongHasItsPlace) {
    const auto first = [](const std::string& text) {
        const ReadPart all = read_part(text);
        return all.complaints.empty() ? "" : first_complaint(all.complaints, "f").what;
    };
    EXPECT_EQ(first(R"({"fleet": {"send": [7]}})"),
              "f:1:21: \"send\" of \"fleet\": expected a name of 1 to 64 bytes without control "
              "characters, found a whole number");
    EXPECT_EQ(first(R"({"fleet": {"send": ["a", "a"]}})"),
              "f:1:26: \"send\" of \"fleet\" has \"a\" a second time; keep one of them");
    EXPECT_EQ(first(R"({"fleet": {"tell": ["speed"]}})"),
              "f:1:21: \"tell\" of \"fleet\": expected NODE.VARIABLE, found \"speed\"");
    for (const char* const text :
         {R"({"fleet": []})", R"({"fleet": {"name": ""}})", R"({"fleet": {"sent": []}})",
          R"({"fleet": {"hear": [{"from": "red"}]}})", R"({"fleet": {"hear": [{"event": ""}]}})",
          R"({"fleet": {"hear": [{"event": "a", "form": "b"}]}})",
          R"({"fleet": {"broker_lost": "halt"}})", R"({"fleet": {"tell": ["drive."]}})"}) {
        EXPECT_NE(first(text), "") << text;
    }
}

TEST(ProjectPart, ListsHaveLimits) {
    const auto faults = [](const char* key, const std::string& items) {
        return read_part(fmt::format(R"({{"fleet": {{"{}": {}}}}})", key, items)).complaints.size();
    };
    EXPECT_EQ(faults("groups", list(kGroupsMax)), 0u);
    EXPECT_EQ(faults("groups", list(kGroupsMax + 1)), 1u);
    EXPECT_EQ(faults("send", list(kEventsMax)), 0u);
    EXPECT_EQ(faults("send", list(kEventsMax + 1)), 1u);
    EXPECT_EQ(faults("hear", list(kEventsMax)), 0u);
    EXPECT_EQ(faults("hear", list(kEventsMax + 1)), 1u);
    EXPECT_EQ(faults("tell", list(kTellMax, "n.", "")), 0u);
    EXPECT_EQ(faults("tell", list(kTellMax + 1, "n.", "")), 1u);
}

}  // namespace
}  // namespace vagus::fleet
