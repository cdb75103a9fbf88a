#include "trial/condition.hpp"

#include <gtest/gtest.h>

namespace vagus::trial {
namespace {

plan::Graph plan_with(std::vector<std::pair<std::string, plan::Type>> variables) {
    plan::GraphPlan plan;
    plan.name = "P";
    for (auto& [name, type] : variables) {
        plan.variables.push_back({.name = name, .type = type, .initial = plan::default_of(type)});
    }
    return {{std::move(plan)}};
}

std::string error_of(std::string_view text, const plan::Graph& plan, bool has_world = true) {
    auto parsed = Condition::parse(text);
    if (!parsed.ok()) return parsed.error().what;
    const Status bound = parsed.value().bind(plan, has_world);
    return bound.ok() ? "" : bound.error().what;
}

TEST(Condition, NamesAreSignalsVariablesAndWords) {
    auto parsed = Condition::parse(
        "contact < 2 and walldist > node(\"drive\", 'sectors[3]') or event < \"node('a')\"");
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
    EXPECT_EQ(condition.names()[3].signal->id, SignalId::Event);
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
    const plan::Graph plan = plan_with({});
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

std::string error_without_plan(std::string_view text) {
    auto parsed = Condition::parse(text);
    if (!parsed.ok()) return parsed.error().what;
    const Status bound = parsed.value().bind_without_plan();
    if (!bound.ok()) return bound.error().what;
    const Status known = parsed.value().check_events({"clear", "turning"});
    return known.ok() ? "" : known.error().what;
}

TEST(Condition, WithoutAPlanThereAreTheWorldAndTheEventsOfTheBus) {
    EXPECT_EQ(error_without_plan("t < 3 and x > 0.5 and contact == 0 and bus < 50"), "");
    EXPECT_EQ(error_without_plan("node('thymio-II', 'free') > 2 and event == 'turning'"), "");
    EXPECT_EQ(error_without_plan("event != '' and 'clear' == event"), "");
    EXPECT_EQ(error_without_plan("event == 'turnin'"),
              "no script on the robot's bus knows an event \"turnin\"; did you mean turning?");
    const std::string instead =
        "\" is of a plan, and there is none; write a signal of the world, as contact, event or "
        "node(\"NODE\", \"NAME\")";
    EXPECT_EQ(error_without_plan("actor == 'a'"), "\"actor" + instead);
    EXPECT_EQ(error_without_plan("variable('x') > 1"), "\"variable('x')" + instead);
    EXPECT_EQ(error_without_plan("contac < 2"),
              "there is no plan, and no signal \"contac\"; did you mean contact?");
    EXPECT_EQ(error_without_plan("echo < 2"),
              "there is no plan, and no signal \"echo\"; write node(\"NODE\", \"echo\") for a "
              "variable of a script, or a signal of `vagus test --signals`");
}

const plan::Template kWatches{.name = "Watches",
                              .kind = plan::Kind::Supervisor,
                              .outcomes = {{.name = "LaneNotFree"}, {.name = "Near"}}};

plan::GraphActor actor(std::string name, std::vector<std::string> states) {
    plan::GraphActor made;
    made.name = std::move(name);
    made.states = std::move(states);
    return made;
}

// A plan whose actor "calibrate" is a plan with the actor "turn"; supervisors in both.
plan::Graph plan_with_another_inside() {
    plan::Graph graph = plan_with({{"mode", plan::Type::String}});
    plan::GraphPlan inside;
    inside.name = "Inside";
    inside.actors = {actor("turn", {"TurnSuccessful"})};
    inside.actors[0].supervisors.emplace_back().of = &kWatches;
    graph.plans[0].actors = {actor("followWall", {"Done"}), actor("calibrate", {"OK", "Error"})};
    graph.plans.push_back(std::move(inside));
    return graph;
}

TEST(Condition, TextsThatCanNeverComeAreRefused) {
    const plan::Graph plan = plan_with_another_inside();
    const std::string no_actor = "the plan has no actor \"followWal\"; did you mean followWall?";
    EXPECT_EQ(error_of("actor == 'followWal'", plan), no_actor);
    EXPECT_EQ(error_of("t > 3 and not \"followWal\" != actor", plan), no_actor);
    EXPECT_EQ(error_of("actor == 'calibrate/turn'", plan),
              "the plan has no actor \"calibrate/turn\"; did you mean turn?");
    EXPECT_EQ(error_of("event == \"LaneNotFre\"", plan),
              "no supervisor of the plan raises \"LaneNotFre\"; did you mean LaneNotFree?");
    EXPECT_EQ(error_of("'TurnSuccessful' == event", plan),
              "\"TurnSuccessful\" is a state of an actor, not an event of a supervisor; there are: "
              "LaneNotFree, Near");
    EXPECT_EQ(error_of("actor == 'a'", plan_with({})),
              "the plan has no actor \"a\"; there is none");
}

TEST(Condition, TextsThatCanComeAreNotRefused) {
    const plan::Graph plan = plan_with_another_inside();
    for (const std::string_view text :
         {"actor == 'followWall' or actor == 'turn' or 'calibrate' != actor",
          "event == 'Near' and event != \"LaneNotFree\"", "actor == '' and '' != event",
          "mode == 'followWal' or variable('mode') == 'LaneNotFre'", "actor < 'g'"}) {
        EXPECT_EQ(error_of(text, plan), "") << text;
    }
}

}  // namespace
}  // namespace vagus::trial
