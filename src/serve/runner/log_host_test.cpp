#include "serve/runner/log_host.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/test_folder.hpp"
#include "serve/json.hpp"
#include "serve/protocol/protocol.hpp"
#include "serve/runner/test_recording.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

// Recorded once for all tests.
const std::string& recording() {
    static const test::Folder folder;
    static const std::string file = record_wall((folder / "run.mcap").string(), "30");
    return file;
}

Json ask(Json asked) {
    asked["file"] = recording();
    return Json::parse(answer_log(asked.dump()));
}

Json at_line(int line, const std::string& values) {
    return ask({{"node", "drive"}, {"line", line}, {"script", "carbot.aesl"}, {"values", values}});
}

Json at_element(const std::string& element, const std::string& when, const std::string& values) {
    return ask({{"plan", "WallFollow.plan.json"},
                {"element", element},
                {"when", when},
                {"values", values}});
}

// Line 193 is `emit drive.arrived [token]`.
TEST(LogHost, ItTellsWhatAScriptHeldEachTime) {
    const Json answer = at_line(193, "token, watch.left[0] / 2");
    ASSERT_FALSE(answer.contains("error")) << answer;
    EXPECT_EQ(Protocol::get().fault_of_answer("log.ask", answer), std::nullopt);
    EXPECT_EQ(answer["names"], Json({"token", "watch.left[0] / 2"}));
    EXPECT_EQ(answer["text"], "  emit drive.arrived [token]");
    EXPECT_EQ(answer["more"], 0);
    ASSERT_EQ(answer["hits"].size(), 1u);
    EXPECT_EQ(answer["hits"][0]["where"], "drive:193");
    EXPECT_EQ(answer["hits"][0]["values"].size(), 2u);
    EXPECT_GE(answer["until"], 15.0);
}

TEST(LogHost, ItTellsWhatAPlanHeldEachTime) {
    const Json answer = at_element("findWallAngle", "leave", "wallangle, walldist * 2");
    ASSERT_FALSE(answer.contains("error")) << answer;
    EXPECT_EQ(Protocol::get().fault_of_answer("log.ask", answer), std::nullopt);
    ASSERT_EQ(answer["hits"].size(), 1u);
    EXPECT_EQ(answer["hits"][0]["values"][1], "60");
    EXPECT_EQ(answer["hits"][0]["where"], "");
    EXPECT_EQ(answer["text"], "");
}

TEST(LogHost, APlaceThatIsNotReachedHasNoHits) {
    const Json answer = at_element("backupCollision", "enter", "walldist");
    EXPECT_EQ(answer["hits"], Json::array());
    EXPECT_EQ(answer["names"], Json::array());
}

// The sentence is shown beside the place, so it does not name it again.
TEST(LogHost, WhatIsNotThereIsRefusedWithoutTheWordsOfTheCommandLine) {
    EXPECT_EQ(at_line(193, "tokn")["error"],
              "the script of drive has no variable \"tokn\"; did you mean token?");
    EXPECT_EQ(at_line(61, "token")["error"],
              "drive has no code at line 1 of its script; the nearest with code: 10");
    EXPECT_EQ(at_element("followWall", "enter", "wallist")["error"],
              "the plan WallFollow has no variable \"wallist\"; did you mean walldist?");
    EXPECT_THAT(at_element("gone", "enter", "walldist")["error"].get<std::string>(),
                HasSubstr("the plan has no actor \"gone\""));
    EXPECT_EQ(ask({{"plan", "Other.plan.json"},
                   {"element", "a"},
                   {"when", "enter"},
                   {"values", "b"}})["error"],
              "the recorded run has no plan Other.plan.json");
}

TEST(LogHost, WhatIsNoQuestionHasNoAnswer) {
    EXPECT_EQ(answer_log("{"), "");
    EXPECT_EQ(answer_log(R"({"file":"run.mcap","values":"x"})"), "");
    const Json answer = Json::parse(answer_log(
        R"({"file":"/no/run.mcap","values":"x","node":"a","line":1,"script":"a.aesl"})"));
    EXPECT_THAT(answer["error"].get<std::string>(), HasSubstr("/no/run.mcap"));
}

}  // namespace
}  // namespace vagus::serve
