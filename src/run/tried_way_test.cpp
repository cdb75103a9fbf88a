#include "run/tried_way.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/json.hpp"
#include "base/time.hpp"
#include "run/answers.hpp"
#include "run/test_plans.hpp"
#include "run/virtual_time.hpp"

namespace vagus::run {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

void add_tried_code(CodeLibrary& library) {
    std::vector<Coded> all;
    all.push_back(unused_actor("Go"));
    all.back().declared.outcomes = {{.name = "Done"}, {.name = "Blocked"}};
    all.push_back(unused_actor("Measure"));
    all.back().declared.outcomes = {{.name = "Done"}};
    all.back().declared.outputs = {{.name = "seen", .type = plan::Type::Int},
                                   {.name = "name", .type = plan::Type::String}};
    all.push_back(test_actor("Count", [](ActorContext& context) {
        context.out(0, plan::Value(context.in(0).integer() + 1));
        context.end(0);
    }));
    all.back().declared.kind = plan::Kind::Computation;
    all.back().declared.inputs = {{.name = "from", .type = plan::Type::Int}};
    all.back().declared.outputs = {{.name = "to", .type = plan::Type::Int}};
    add_blind_supervisors(all);
    library.add("core", "", std::move(all));
}

const std::string kTriedPlan = R"({ "format": "vagus-plan/1", "name": "Main",
  "configuration": { "n": { "type": "int", "initial": 0, "access": "out" } },
  "start": { "actor": "a", "supervisors": {
    "hear": { "template": "Hear", "events": { "Seen": "b" } } } },
  "actors": {
    "a": { "template": "Go", "states": { "Done": "count", "Blocked": "a" },
      "supervisors": { "see": { "template": "See", "events": { "Seen": "@ignore" } } } },
    "count": { "template": "Count", "in": { "from": "n" }, "out": { "to": "n" },
      "states": { "Done": "a" } },
    "b": { "template": "Go", "states": { "Done": "@terminate", "Blocked": "a" } } } })";

class TriedWayTest : public testing::Test {
protected:
    TriedWayTest() {
        add_tried_code(library_);
        graph_ = test_graph(kTriedPlan, library_);
    }
    // The lines of the trace until the way waits, or the plan ends.
    std::vector<std::string> run(TriedWay& way) {
        return run_with(way, with_checks_in_time(graph_, [](const auto&) { return true; }), way);
    }
    std::vector<std::string> run_with(CodeSource& source, const plan::Graph& graph, TriedWay& way) {
        std::vector<std::string> lines;
        bool waits = false;
        writes_.clear();
        RunOptions options;
        options.max_time = std::chrono::seconds(1000);
        options.code_source = &source;
        options.on_trace = [&](const plan::TraceEvent& event) {
            if (waits) return;
            lines.push_back(test_line(event));
            const auto* const write = std::get_if<plan::VariableWritten>(&event.what);
            if (write) {
                writes_.push_back(
                    fmt::format("{}={}", write->variable, plan::text_of(write->value).value()));
            }
        };
        VirtualTime run(graph, library_, options);
        way.at_its_end([&] {
            waits = true;
            run.abort();
        });
        ended_ = run.run();
        return lines;
    }
    static std::vector<std::string> told(const TriedWay& way) {
        std::vector<std::string> turns;
        for (const TriedWay::Turn& turn : way.turns()) {
            turns.push_back(fmt::format("{} {}{}{}", turn.path, turn.actor,
                                        turn.state.empty() ? "" : " " + turn.state,
                                        turn.by.empty() ? "" : " by " + turn.by));
        }
        return turns;
    }

    CodeLibrary library_;
    plan::Graph graph_;
    Ended ended_;
    std::vector<std::string> writes_;  // of the last run
};

TEST_F(TriedWayTest, ThePlanRunsToTheFirstActorAndWaits) {
    TriedWay way({});
    run(way);
    EXPECT_THAT(told(way), ElementsAre("Main a"));
    ASSERT_NE(way.waits(), nullptr);
    EXPECT_EQ(way.waits()->actor, "a");
    EXPECT_THAT(way.waits_of()->states, ElementsAre("Done", "Blocked"));
    EXPECT_EQ(way.left(), 0u);
}

TEST_F(TriedWayTest, ActorsEndAndSupervisorsRaiseAsChosenAndComputationsCompute) {
    TriedWay way({{"Main", "a", "Blocked"},
                  {"Main", "see", "Seen"},
                  {"Main", "a", "Done"},
                  {"Main", "hear", "Seen"},
                  {"Main", "b", "Done"}});
    const std::vector<std::string> lines = run(way);
    EXPECT_THAT(told(way),
                ElementsAre("Main a Blocked", "Main a Done", "Main a by hear.Seen", "Main b Done"));
    EXPECT_THAT(lines, testing::Contains("actor-end count"));
    EXPECT_EQ(way.waits(), nullptr);
    EXPECT_EQ(way.taken().size(), 5u);
    EXPECT_EQ(ended_.result, plan::PlanResult::Ok);
}

TEST_F(TriedWayTest, AChoiceOfAnotherSituationIsLeft) {
    for (const TriedChoice& wrong : {TriedChoice{"Main", "b", "Done"},
                                     {"Main", "a", "Gone"},
                                     {"Main", "see", "Gone"},
                                     {"Main/x", "a", "Done"}}) {
        TriedWay way({{"Main", "a", "Blocked"}, wrong, {"Main", "a", "Done"}});
        run(way);
        EXPECT_EQ(way.left(), 2u) << wrong.element;
        EXPECT_NE(way.waits(), nullptr);
    }
}

TEST_F(TriedWayTest, ARunWithItsAnswersTakesTheSameWay) {
    TriedWay way({{"Main", "see", "Seen"},
                  {"Main", "a", "Blocked"},
                  {"Main", "hear", "Seen"},
                  {"Main", "b", "Blocked"},
                  {"Main", "a", "Done"},
                  {"Main", "hear", "Seen"}});
    const std::vector<std::string> lines = run(way);
    EXPECT_EQ(way.waits()->actor, "b");
    const JsonValue json = parse_json(way.answers(graph_), "x.test.json").value();
    const Answers answers = Answers::read(json, "x.test.json", graph_).value();
    AnsweringCode code(answers);
    std::vector<std::string> again = run_with(code, answers.checked_in_time(graph_), way);
    ASSERT_GE(again.size(), lines.size());
    again.resize(lines.size());
    EXPECT_EQ(again, lines);
    // And nothing more: the last one never ends.
    EXPECT_TRUE(ended_.timed_out);
}

TEST_F(TriedWayTest, AnActorGivesTheOutputsThatWereChosen) {
    graph_ = test_graph(R"({ "format": "vagus-plan/1", "name": "Main",
        "configuration": { "n": { "type": "int", "initial": 7, "access": "out" },
                           "s": { "type": "string", "initial": "", "access": "out" } },
        "start": { "actor": "a" },
        "actors": { "a": { "template": "Measure", "out": { "seen": "n", "name": "s" },
                           "states": { "Done": "a" } } } })",
                        library_);
    TriedWay way({{"Main", "a", "Done", {{"seen", plan::Value(int64_t{3})}}},
                  {"Main", "a", "Done"},
                  {"Main", "a", "Done", {{"name", plan::Value(std::string("\"x\""))}}}});
    run(way);
    EXPECT_EQ(writes_, (std::vector<std::string>{"n=7", "s=", "n=3", "s=\"x\""}));
    EXPECT_EQ(way.left(), 0u);
    EXPECT_EQ(way.waits_of()->outputs.size(), 2u);
    const JsonValue json = parse_json(way.answers(graph_), "x.test.json").value();
    const Answers answers = Answers::read(json, "x.test.json", graph_).value();
    AnsweringCode code(answers);
    run_with(code, graph_, way);
    EXPECT_EQ(writes_, (std::vector<std::string>{"n=7", "s=", "n=3", "s=\"x\""}));
    // An output that it does not have.
    TriedWay wrong({{"Main", "a", "Done", {{"sen", plan::Value(int64_t{3})}}}});
    run(wrong);
    EXPECT_EQ(wrong.left(), 1u);
}

TEST_F(TriedWayTest, WhatIsNotComeToHasAnAnswerThatNeverComes) {
    TriedWay way({});
    run(way);
    const JsonValue json = parse_json(way.answers(graph_), "x.test.json").value();
    EXPECT_EQ(json.find("b")->items.at(0).find("after")->number, 1e6);
    EXPECT_THAT(json.find("see.Seen")->items, IsEmpty());
    EXPECT_EQ(json.find("count"), nullptr);
}

}  // namespace
}  // namespace vagus::run
