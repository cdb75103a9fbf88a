#include "trial/condition.hpp"

#include <gtest/gtest.h>

namespace vagus::trial {
namespace {

plan::GraphPlan plan_with(std::vector<std::pair<std::string, plan::Type>> variables) {
    plan::GraphPlan plan;
    plan.name = "P";
    for (auto& [name, type] : variables) {
        plan.variables.push_back({.name = name, .type = type, .initial = plan::default_of(type)});
    }
    return plan;
}

std::string error_of(std::string_view text, const plan::GraphPlan& plan, bool has_world = true) {
    auto parsed = Condition::parse(text);
    if (!parsed.ok()) return parsed.error().what;
    const Status bound = parsed.value().bind(plan, has_world);
    return bound.ok() ? "" : bound.error().what;
}

TEST(Condition, NamesAreSignalsVariablesAndWords) {
    auto parsed = Condition::parse(
        "contact < 2 and walldist > node(\"drive\", 'sectors[3]') or actor == \"node('a')\"");
    ASSERT_TRUE(parsed.ok()) << parsed.error().what;
    Condition& condition = parsed.value();
    ASSERT_TRUE(condition.bind(plan_with({{"walldist", plan::Type::Float}}), true).ok());
    ASSERT_EQ(condition.names().size(), 4u);
    EXPECT_EQ(condition.names()[0].signal->id, SignalId::Contact);
    EXPECT_EQ(condition.names()[1].slot, 0);
    EXPECT_EQ(condition.names()[2].node, "drive");
    EXPECT_EQ(condition.names()[2].variable, "sectors");
    EXPECT_EQ(condition.names()[2].element, 3);
    EXPECT_EQ(condition.names()[2].shown, "node(\"drive\", 'sectors[3]')");
    EXPECT_EQ(condition.names()[3].signal->id, SignalId::Actor);
    EXPECT_TRUE(condition.uses(SignalId::Contact));
    EXPECT_FALSE(condition.uses(SignalId::Bus));
    // 1 < 2, and 30 > 7.
    const plan::Value values[] = {plan::Value(1.0), plan::Value(30.0), plan::Value(int64_t{7}),
                                  plan::Value(std::string("x"))};
    EXPECT_TRUE(condition.holds(values).value());
}

TEST(Condition, AVariableThatIsCalledLikeASignalIsAskedFor) {
    const auto plan = plan_with({{"angle", plan::Type::Int}});
    EXPECT_EQ(error_of("angle > 3", plan),
              "\"angle\" is a signal, and a variable of the plan P too; write variable(\"angle\") "
              "for that one, or rename it");
    EXPECT_EQ(error_of("variable(\"angle\") > 3", plan), "");
}

TEST(Condition, WhatIsUnknownIsNamedWithTheNearest) {
    const auto plan = plan_with({{"speed", plan::Type::Int}});
    EXPECT_EQ(
        error_of("sped > 3", plan),
        "there is no \"sped\" in the plan P, and no signal of that name; did you mean speed?");
    EXPECT_EQ(error_of("contact < 2", plan, false),
              "\"contact\" is of a robot in a world; give the test a \"world\"");
    EXPECT_EQ(error_of("node('a', 'b') < 2", plan, false),
              "node('a', 'b') is of a robot in a world; give the test a \"world\"");
}

TEST(Condition, CallsThatAreWrittenWrongAreExplained) {
    const plan::GraphPlan plan = plan_with({});
    const std::string two = "expected two texts, as node(\"drive\", \"token\"), behind node";
    EXPECT_EQ(error_of("node(drive, token) > 1", plan), two);
    EXPECT_EQ(error_of("node('drive') > 1", plan), two);
    EXPECT_EQ(error_of("node('drive', 'token'", plan), two);
    EXPECT_EQ(error_of("node('drive', 'token[x]') > 1", plan),
              "\"token[x]\": expected the number of an element in brackets, as "
              "\"touch.sectors[2]\"");
    EXPECT_EQ(error_of("node('drive', 'token[') > 1", plan),
              "\"token[\": expected the number of an element in brackets, as "
              "\"touch.sectors[2]\"");
    EXPECT_NE(error_of("contact <", plan), "");
}

}  // namespace
}  // namespace vagus::trial
