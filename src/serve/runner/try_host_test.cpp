#include "serve/runner/try_host.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "serve/json.hpp"
#include "serve/protocol/protocol.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

const std::string kInner = R"({"format": "vagus-plan/1", "name": "Nap",
    "start": {"actor": "sleep"},
    "actors": {"sleep": {"template": "Wait", "in": {"seconds": 2}, "states": {"Done": "@terminate"},
        "supervisors": {"late": {"template": "Timeout", "in": {"seconds": 9},
                                 "events": {"Timeout": "sleep"}}}}}})";
const std::string kOuter = R"({"format": "vagus-plan/1", "name": "Day",
    "configuration": {"n": {"type": "int", "initial": 0}},
    "start": {"actor": "count", "supervisors": {"over": {"template": "Timeout",
        "in": {"seconds": 99}, "events": {"Timeout": "@terminate"}}}},
    "actors": {"count": {"template": "Assign", "in": {"value": "n + 1"}, "out": {"result": "n"},
                         "states": {"Done": "nap"}},
               "nap": {"plan": "Nap.plan.json", "states": {"OK": "count", "Error": "@terminate",
                                                           "Interrupted": "@terminate"}}}})";

class TryHostTest : public testing::Test {
protected:
    static Json question(const Json& way, bool keep = false) {
        return {{"plan", "/no/Day.plan.json"},
                {"texts", {{"/no/Day.plan.json", kOuter}, {"/no/Nap.plan.json", kInner}}},
                {"toolboxes", Json::array()},
                {"way", way},
                {"keep", keep}};
    }
    static Json choice(const char* path, const char* element, const char* outcome) {
        return {{"path", path}, {"element", element}, {"outcome", outcome}};
    }
    static Json ask(const Json& way, bool keep = false) {
        return Json::parse(answer_try(question(way, keep).dump()));
    }
};

TEST_F(TryHostTest, ItTellsWhereThePlanWaitsAndWhatCanBeChosen) {
    const Json answer = ask(Json::array());
    ASSERT_FALSE(answer.contains("error")) << answer;
    EXPECT_EQ(Protocol::get().fault_of_answer("plan.try", answer), std::nullopt);
    EXPECT_EQ(answer["waits"]["path"], "Day/nap");
    EXPECT_EQ(answer["waits"]["states"], Json({"Done"}));
    // The computation has computed.
    EXPECT_EQ(answer["plan"]["levels"][0]["variables"][0]["value"], 1);
    EXPECT_EQ(answer["plan"]["levels"][1]["actor"], "sleep");
    std::vector<std::string> raises;
    for (const Json& one : answer["raises"]) {
        raises.push_back(one["path"].get<std::string>() + " " +
                         one["supervisor"].get<std::string>() + " " + one["events"].dump());
    }
    EXPECT_THAT(raises, testing::UnorderedElementsAre("Day over [\"Timeout\"]",
                                                      "Day/nap late [\"Timeout\"]"));
}

TEST_F(TryHostTest, AWayThroughASubPlanIsToldToItsEnd) {
    const Json answer =
        ask(Json::array({choice("Day/nap", "late", "Timeout"), choice("Day/nap", "sleep", "Done"),
                         choice("Day", "over", "Timeout")}));
    EXPECT_EQ(answer["left"], 0);
    EXPECT_FALSE(answer.contains("waits"));
    EXPECT_EQ(answer["plan"]["state"], "ended");
    EXPECT_EQ(answer["plan"]["result"], "Interrupted");
    ASSERT_EQ(answer["turns"].size(), 3u);
    EXPECT_EQ(answer["turns"][0]["end"], "late.Timeout");
    EXPECT_EQ(answer["turns"][0]["interrupted"], true);
    EXPECT_EQ(answer["turns"][1]["end"], "Done");
    EXPECT_EQ(answer["turns"][2]["end"], "over.Timeout");
}

TEST_F(TryHostTest, ATestOfAWayNamesItsOrderAndItsEnd) {
    const Json waiting = ask(Json::array({choice("Day/nap", "sleep", "Done")}), true);
    ASSERT_FALSE(waiting.contains("error")) << waiting;
    const Json test = Json::parse(waiting["test"].get<std::string>());
    EXPECT_EQ(test["plan"], "Day.plan.json");
    EXPECT_EQ(test["expect"], Json::parse(R"([{"order": ["nap/sleep", "nap/sleep"]},
                                              {"ends": "MaxTime"}])"));
    const Json over = ask(Json::array({choice("Day", "over", "Timeout")}), true);
    const Json ends = Json::parse(over["test"].get<std::string>());
    EXPECT_EQ(ends["expect"][1]["ends"], "Interrupted");
}

TEST_F(TryHostTest, APlanWithErrorsIsNotTried) {
    Json in = question(Json::array());
    in["texts"]["/no/Nap.plan.json"] = R"({"format": "vagus-plan/1", "name": "Nap"})";
    const Json answer = Json::parse(answer_try(in.dump()));
    EXPECT_THAT(answer["error"].get<std::string>(), HasSubstr("/no/Nap.plan.json:1"));
    EXPECT_EQ(answer_try("[]"), "");
    EXPECT_EQ(answer_try("{"), "");
}

}  // namespace
}  // namespace vagus::serve
