// Answers in place of the toolbox's code: who answers when, and what of the JSON is refused where.
#include "run/answers.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/test_plans.hpp"
#include "run/virtual_time.hpp"

namespace vagus::run {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

void add_test_code(CodeLibrary& library) {
    std::vector<Coded> all;
    all.push_back(unused_actor("Go"));
    all.back().declared.outcomes = {{.name = "Done"}, {.name = "Blocked"}};
    all.back().declared.outputs = {{.name = "way", .type = plan::Type::Int}};
    add_blind_supervisors(all);
    library.add("core", "", std::move(all));
}

const std::string kAnsweredPlan = R"({ "format": "vagus-plan/1", "name": "Main",
  "configuration": { "n": { "type": "int", "initial": 0, "access": "out" } },
  "start": { "actor": "a", "supervisors": {
    "hear": { "template": "Hear", "events": { "Seen": "b" } } } },
  "actors": {
    "a": { "template": "Go", "out": { "way": "n" }, "states": { "Done": "b", "Blocked": "a" },
      "supervisors": { "see": { "template": "See", "events": { "Seen": "@ignore" } } } },
    "b": { "template": "Go", "states": { "Done": "@terminate", "Blocked": "@terminate" } } } })";

class AnswersTest : public testing::Test {
protected:
    AnswersTest() {
        add_test_code(library_);
        graph_ = test_graph(kAnsweredPlan, library_);
    }

    Result<Answers> read(const std::string& json) {
        return Answers::read(parse_json(json, "x.test.json").value(), "x.test.json", graph_);
    }
    std::string error(const std::string& json) {
        const Result<Answers> answers = read(json);
        return answers.ok() ? "" : answers.error().what;
    }
    std::vector<std::string> run(const std::string& json) {
        const Answers answers = read(json).value();
        AnsweringCode code(answers);
        const plan::Graph graph = answers.checked_in_time(graph_);
        std::vector<std::string> lines;
        RunOptions options;
        options.on_trace = [&lines](const plan::TraceEvent& event) {
            const std::string line = test_line(event);
            if (line != "other") {
                lines.push_back(fmt::format("{} {}", event.at.count() / 1000, line));
            }
        };
        options.code_source = &code;
        VirtualTime(graph, library_, options).run();
        return lines;
    }

    CodeLibrary library_;
    plan::Graph graph_;
};

TEST_F(AnswersTest, EachRunningTakesTheNextAnswerAndTheLastHolds) {
    EXPECT_THAT(
        run(R"({"a": [{"after": 2, "state": "Blocked"}, {"after": 0.5, "state": "Done"}],
                        "Go": [{}]})"),
        ElementsAre("0 plan-start", "0 actor-start a", "2000 actor-end a", "2000 actor-start a",
                    "2500 actor-end a", "2500 actor-start b", "2500 actor-end b", "2500 plan-end"));
}

TEST_F(AnswersTest, ASupervisorRaisesAtItsTimeAlsoOneThatWaitsForEvents) {
    EXPECT_THAT(run(R"({"a": [{"after": 9}], "b": [{"after": 1}], "hear.Seen": [{"at": 3.5}],
                        "see.Seen": [{"at": 1}, {"at": 2.001}]})"),
                ElementsAre("0 plan-start", "0 actor-start a", "1000 event see", "2010 event see",
                            "3500 event hear", "3500 interrupted a", "3500 actor-start b",
                            "4500 actor-end b", "4500 plan-end"));
}

TEST_F(AnswersTest, OutputsAreWritten) {
    const Answers answers = read(R"({"Go": [{"state": "Done", "out": {"way": 7}}]})").value();
    AnsweringCode code(answers);
    RunOptions options;
    std::string written;
    options.on_trace = [&written](const plan::TraceEvent& event) {
        if (const auto* write = std::get_if<plan::VariableWritten>(&event.what)) {
            written += fmt::format("{} by {};", write->value.integer(), write->by);
        }
    };
    options.code_source = &code;
    VirtualTime(graph_, library_, options).run();
    EXPECT_EQ(written, "0 by initial;7 by a;");
}

TEST_F(AnswersTest, WhatThePlanDoesNotHaveIsNamedWithItsPlace) {
    EXPECT_EQ(error(R"({"Fly": [{}]})"),
              "x.test.json:1:2: no actor and no template of one is called \"Fly\"");
    EXPECT_THAT(error(R"({"hear.Sen": [{"at": 1}]})"), HasSubstr("did you mean \"hear.Seen\"?"));
    EXPECT_THAT(error(R"({"a": [{"state": "Don"}]})"),
                HasSubstr("1:18: it has no state \"Don\"; did you mean \"Done\"?"));
    EXPECT_THAT(error(R"({"a": [{"out": {"wya": 1}}]})"), HasSubstr("did you mean \"way\"?"));
    EXPECT_THAT(error(R"({"a": [{"aftr": 1}]})"), HasSubstr("did you mean \"after\"?"));
    EXPECT_THAT(error(R"({"a": [{"after": -1}]})"), HasSubstr("from 0 to"));
    EXPECT_THAT(error(R"({"a": [{"after": 1000000001}]})"), HasSubstr("from 0 to"));
    EXPECT_THAT(error(R"({"a": []})"), HasSubstr("has no answer"));
    EXPECT_THAT(error(R"({"a": {}})"), HasSubstr("must be"));
    EXPECT_THAT(error(R"({"see.Seen": [{"at": 1, "state": "x"}]})"), HasSubstr("and no more"));
}

TEST_F(AnswersTest, OneMoreThanTheLimitIsRefused) {
    const auto many = [](size_t count) {
        std::string text = "{\"a\": [{}";
        for (size_t i = 1; i < count; ++i) text += ",{}";
        return text + "]}";
    };
    EXPECT_EQ(error(many(kAnswersMax)), "");
    EXPECT_THAT(error(many(kAnswersMax + 1)), HasSubstr("more than 10000 answers"));
}

}  // namespace
}  // namespace vagus::run
