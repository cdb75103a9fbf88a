#include "serve/run/break_place.hpp"

#include <gtest/gtest.h>

#include "plan/file.hpp"

namespace vagus::serve {
namespace {

constexpr std::string_view kRounds = R"({
  "format": "vagus-plan/1",
  "name": "Rounds",
  "start": {
    "actor": "say",
    "supervisors": { "late": { "template": "Timeout", "in": { "seconds": 9 }, "events": {} } }
  },
  "actors": {
    "say": { "template": "Unknown", "states": { "Done": "wait" } },
    "wait": { "template": "Wait", "in": { "seconds": 1 }, "states": {} }
  }
})";

// "" if it can be set.
std::string refusal(const std::string& kind, const std::string& element,
                    const std::string& outcome = "") {
    plan::Library library;
    library.add(
        {.name = "core",
         .templates = {
             {.name = "Wait", .outcomes = {{"Done"}}},
             {.name = "Timeout", .kind = plan::Kind::Supervisor, .outcomes = {{"Timeout"}}}}});
    PlanBreakpoint wanted;
    wanted.kind = kind;
    wanted.element = element;
    wanted.outcome = outcome;
    const plan::PlanFile file = plan::parse_plan(kRounds, "rounds.plan.json");
    EXPECT_TRUE(file.readable);
    const Status there = check_break_place(wanted, file.plan, library);
    if (there.ok()) return "";
    EXPECT_EQ(there.error().code, Code::NotFound);
    return there.error().what;
}

TEST(BreakPlace, WhatThePlanHasCanHaveOne) {
    EXPECT_EQ(refusal("actor", "say"), "");
    EXPECT_EQ(refusal("state", "say"), "");
    EXPECT_EQ(refusal("event", "late", "Timeout"), "");
    EXPECT_EQ(refusal("condition", ""), "");
    // A state that leads nowhere yet, and one of a template that nobody knows.
    EXPECT_EQ(refusal("state", "wait", "Done"), "");
    EXPECT_EQ(refusal("state", "say", "Failed"), "");
}

TEST(BreakPlace, WhatItHasNotIsRefusedWithWhatThereIs) {
    EXPECT_EQ(refusal("actor", "sey"), "the plan Rounds has no actor “sey”; did you mean say?");
    EXPECT_EQ(refusal("actor", "late"),
              "the plan Rounds has no actor “late”; there are: say, wait");
    EXPECT_EQ(refusal("state", "wait", "Failed"),
              "the actor wait has no state “Failed”; there are: Done");
    EXPECT_EQ(refusal("event", "say"), "the plan Rounds has no supervisor “say”; there are: late");
    EXPECT_EQ(refusal("event", "late", "Timeuot"),
              "the supervisor late has no event “Timeuot”; did you mean Timeout?");
}

TEST(BreakPlace, AConditionReadsVariablesOfItsPlan) {
    const auto refusal_of = [](const std::string& text, const std::string& condition) {
        PlanBreakpoint wanted;
        wanted.condition = condition;
        const Status there =
            check_break_variables(wanted, plan::parse_plan(text, "rounds.plan.json").plan);
        if (there.ok()) return std::string();
        EXPECT_EQ(there.error().code, Code::NotFound);
        return there.error().what;
    };
    const std::string with_variables =
        R"({"format": "vagus-plan/1", "name": "Rounds", "start": {"actor": "say"}, "actors": {},
            "configuration": {"distance": {"type": "int", "initial": 1},
                              "far": {"type": "bool", "initial": false}}})";
    EXPECT_EQ(refusal_of(with_variables, ""), "");
    EXPECT_EQ(refusal_of(with_variables, "distance < 5 and not far"), "");
    // One that is no formula is refused as such.
    EXPECT_EQ(refusal_of(with_variables, "near >"), "");
    EXPECT_EQ(refusal_of(with_variables, "distence < 5"),
              "the plan Rounds has no variable “distence”; did you mean distance?");
    EXPECT_EQ(refusal_of(with_variables, "distance < limit"),
              "the plan Rounds has no variable “limit”; there are: distance, far");
}

TEST(BreakPlace, AConditionIsAFormula) {
    PlanBreakpoint wanted;
    EXPECT_TRUE(check_break_condition(wanted).ok());
    wanted.condition = "distance < 5 and far";
    EXPECT_TRUE(check_break_condition(wanted).ok());
    wanted.condition = "distance >";
    const Status refused = check_break_condition(wanted);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, Code::BadInput);
    EXPECT_EQ(refused.error().what.find("in.condition: "), 0u);
    EXPECT_NE(refused.error().what.find("position 11"), std::string::npos) << refused.error().what;
}

}  // namespace
}  // namespace vagus::serve
