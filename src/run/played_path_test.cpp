// A path that exploration found, played in virtual time.
#include "run/played_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/test_plans.hpp"
#include "run/virtual_time.hpp"

namespace vagus::run {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using Step = plan::ExploreStep;

// Of their own they would end at once, and raise at every check.
class AlwaysSees final : public Supervisor {
    std::optional<plan::Given> check(const Check&) override { return plan::Given{}; }
};

void add_code_that_sees(CodeLibrary& library) {
    std::vector<Coded> all;
    all.push_back(test_actor("Go", [](ActorContext& context) { context.end(0); }));
    all.back().declared.outcomes = {{.name = "Done"}, {.name = "Blocked"}};
    all.push_back(test_supervisor("See", 10, [] { return std::make_unique<AlwaysSees>(); }));
    all.push_back(test_supervisor("Hear", 0, [] { return std::make_unique<AlwaysSees>(); }));
    library.add("core", "", std::move(all));
}

const std::string kPlayedPlan = R"({ "format": "vagus-plan/1", "name": "Main", "start": {
  "actor": "a", "supervisors": { "hear": { "template": "Hear", "events": { "Seen": "c" } } } },
  "actors": {
    "a": { "template": "Go", "states": { "Done": "a", "Blocked": "b" } },
    "b": { "template": "Go", "states": { "Done": "b", "Blocked": "@terminate" }, "supervisors": {
      "see": { "template": "See", "events": { "Seen": "a" } } } },
    "c": { "template": "Go", "states": { "Done": "c", "Blocked": "c" } } } })";

struct Played {
    std::vector<std::string> lines;
    std::vector<Time> times;
    size_t left = 0;
    Ended ended;
};

Played played(const std::vector<Step>& steps) {
    CodeLibrary library;
    add_code_that_sees(library);
    const plan::Graph graph = with_checks_in_time(
        test_graph(kPlayedPlan, library), [](const plan::GraphSupervisor&) { return true; });
    Played result;
    PlayedPath path(steps);
    RunOptions options;
    options.on_trace = [&result](const plan::TraceEvent& event) {
        result.lines.push_back(test_line(event));
        result.times.push_back(event.at);
    };
    options.code_source = &path;
    VirtualTime run(graph, library, options);
    path.at_its_end([&run] { run.abort(); });
    result.ended = run.run();
    result.left = path.left();
    return result;
}

TEST(PlayedPath, TakesEachStepASecondAfterTheOneBefore) {
    const Played result = played({{Step::Kind::End, "Main", "a", "Blocked", "b"},
                                  {Step::Kind::Event, "Main", "see", "Seen", "a"},
                                  {Step::Kind::Event, "Main", "hear", "Seen", "c"}});
    EXPECT_THAT(result.lines,
                ElementsAre("plan-start", "actor-start a", "actor-end a", "actor-start b",
                            "event see", "interrupted b", "actor-start a", "event hear",
                            "interrupted a", "actor-start c", "interrupted c", "plan-end"));
    EXPECT_EQ(result.times[2], 1s);
    EXPECT_EQ(result.times[4], 2s);
    EXPECT_EQ(result.times[7], 3s);
    EXPECT_EQ(result.left, 0u);
    EXPECT_EQ(result.ended.result, plan::PlanResult::Interrupted);
}

TEST(PlayedPath, APathToTheEndEndsTheRun) {
    const Played result = played({{Step::Kind::End, "Main", "a", "Blocked", "b"},
                                  {Step::Kind::End, "Main", "b", "Blocked", "@terminate"}});
    EXPECT_EQ(result.left, 0u);
    EXPECT_EQ(result.ended.result, plan::PlanResult::Ok);
}

TEST(PlayedPath, AnErrorIsPlayedToo) {
    const Played result = played({{Step::Kind::Error, "Main", "a", "", ""}});
    EXPECT_EQ(result.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(result.ended.message, testing::HasSubstr("as the path says"));
}

}  // namespace
}  // namespace vagus::run
