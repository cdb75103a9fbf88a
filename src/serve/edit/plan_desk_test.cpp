#include "serve/edit/plan_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "serve/edit/test_page.hpp"

namespace vagus::serve {
namespace {

using testing::StartsWith;

constexpr std::string_view kPlan = R"({
  "format": "vagus-plan/1",
  "name": "P",
  "configuration": { "speed": { "type": "float", "initial": 1.5 } },
  "start": {
    "actor": "a",
    "supervisors": {
      "late": {
        "template": "Timeout", "in": { "seconds": 9 }, "events": { "Timeout": "@terminate" }
      }
    }
  },
  "actors": {
    "a": {
      "template": "Wait", "in": { "seconds": "speed" }, "states": { "Done": "@terminate" },
      "supervisors": {
        "slow": { "template": "Timeout", "in": { "seconds": 5 }, "events": { "Timeout": "a" } }
      }
    }
  }
}
)";

// What a mark is about, and its lines.
std::vector<std::string> marks_of(const nlohmann::json& code) {
    std::vector<std::string> marks;
    for (const auto& one : code["marks"]) {
        std::string keys;
        for (const auto& key : one["keys"]) keys += key.get<std::string>() + "/";
        marks.push_back(keys + " " + one["first"].dump() + "-" + one["last"].dump());
    }
    return marks;
}

TEST_F(EditTest, TheCodeOfAPlanSaysWhichLinesBelongToWhichElement) {
    write("P.plan.json", kPlan);
    enter({.plan = "P.plan.json"});
    const Json code = ask("plan.code", {{"doc", "P.plan.json"}});
    EXPECT_EQ(code["name"], "P.cpp");
    EXPECT_EQ(code["findings"], Json::array());
    EXPECT_EQ(code["text"],
              "// The plan P.\n#include \"P.hpp\"\n\n"
              R"(#include <vagus/templates/core.hpp>

vagus::embed::Plan plans::make_P() {
    using vagus::embed::Plan;
    using vagus::embed::Type;
    namespace core = vagus::templates::core;

    // ---- actors ----
    core::Wait a("a", {.seconds = "speed"});

    // ---- supervisors ----
    core::Timeout late("late", {.seconds = "9"});
    core::Timeout slow("slow", {.seconds = "5"});

    // ---- the plan ----
    Plan plan("P");
    plan.variable("speed", Type::Float, {.initial = 1.5});
    plan.start_with(a);
    plan.always(late, core::Timeout::Timeout_, Plan::kTerminate);

    // a
    plan.after(a, core::Wait::Done, Plan::kTerminate);
    plan.during(a, slow, core::Timeout::Timeout_, a);

    return plan;
}
)");
    EXPECT_THAT(
        marks_of(code),
        testing::ElementsAre("actors/a/ 12-12", "start/supervisors/late/ 15-15",
                             "actors/a/supervisors/slow/ 16-16", "configuration/speed/ 20-20",
                             "start/ 21-21", "start/supervisors/late/ 22-22", "actors/a/ 24-25",
                             "actors/a/supervisors/slow/ 26-26"));
}

TEST_F(EditTest, TheCodeIsThatOfThePlanAsItIsEdited) {
    write("P.plan.json", kPlan);
    enter({.plan = "P.plan.json"});
    put("P.plan.json", "\"seconds\": \"speed\"", "\"seconds\": \"speed * 2\"");
    const Json code = ask("plan.code", {{"doc", "P.plan.json"}});
    EXPECT_THAT(code["text"].get<std::string>(),
                testing::HasSubstr("core::Wait a(\"a\", {.seconds = \"speed * 2\"});"));
}

TEST_F(EditTest, APlanWithErrorsHasNoCodeButFindings) {
    write("P.plan.json", kPlan);
    enter({.plan = "P.plan.json"});
    put("P.plan.json", "\"seconds\": \"speed\"", "\"seconds\": \"sped\"");
    const Json code = ask("plan.code", {{"doc", "P.plan.json"}});
    EXPECT_EQ(code["text"], "");
    ASSERT_EQ(code["findings"].size(), 1u);
    EXPECT_EQ(code["findings"][0]["code"], "P8");
    EXPECT_EQ(code["findings"][0]["keys"], Json({"actors", "a", "in", "seconds"}));
    EXPECT_THAT(refusal("plan.code", {{"doc", "none.plan.json"}}), StartsWith("not_found: "));
}

}  // namespace
}  // namespace vagus::serve
