// The runner's talk with a plan that runs on the same thread, as in a simulated world.
#include "serve/runner/plan_talk.hpp"

#include <gtest/gtest.h>

#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/virtual_time.hpp"
#include "serve/runner/plan_stops.hpp"
#include "toolbox/core.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;

// Counts n up to 5, one a second; its sixth step, at 6 s, finds it above 4 and ends the plan.
constexpr const char* kCount = R"({
  "format": "vagus-plan/1",
  "name": "Count",
  "configuration": { "n": { "type": "int", "initial": 0 } },
  "start": { "actor": "wait" },
  "actors": {
    "wait": { "template": "Wait", "in": { "seconds": "1" }, "states": { "Done": "step" } },
    "step": { "template": "For", "in": { "counter": "n", "last": "4" },
      "out": { "counter": "n" }, "states": { "Loop": "wait", "Done": "@terminate" } }
  }
})";

// Runs the plan to its end; `when_paused` is called with why, each time it pauses.
struct OneThread {
    OneThread() {
        toolbox::add_core(library);
        checked = plan::check("count.plan.json", files, library.templates());
        graph = plan::make_graph(checked);
        talk.emplace(graph);
    }
    run::Ended run(std::function<void(const PlanTalk::Heard&)> when_paused) {
        run::RunOptions options;
        options.debugger = &talk->debugger();
        talk->debugger().while_paused([this, when_paused = std::move(when_paused)] {
            const PlanTalk::Heard heard = talk->hear();
            stops.tend(*talk);
            if (heard.broken || heard.stepped) when_paused(heard);
        });
        stops.tend(*talk);
        const run::Ended ended = run::VirtualTime(graph, library, options).run();
        (void)talk->hear();
        return ended;
    }

    plan::OneText files{kCount};
    run::CodeLibrary library;
    plan::Checked checked;
    plan::Graph graph;
    std::optional<PlanTalk> talk;
    PlanStops stops;
};

talk::BreakpointOrder at_step(uint64_t stop_at) {
    return {.number = 7, .plan = "count.plan.json", .element = "step", .stop_at = stop_at};
}

TEST(PlanTalk, APlanOnTheSameThreadStandsAtABreakpointAndGoesOn) {
    OneThread plan;
    plan.stops.want({at_step(4)});
    std::vector<Time> paused;
    const run::Ended ended = plan.run([&](const PlanTalk::Heard& heard) {
        paused.push_back(heard.broken->where.at);
        EXPECT_EQ(plan.stops.numbers(heard.broken->breakpoints), std::vector<uint64_t>{7});
        plan.talk->go_on();
    });
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
    EXPECT_EQ(paused, (std::vector<Time>{4s, 5s, 6s}));
}

TEST(PlanTalk, TheHitsOfABreakpointAreToldWhileThePlanStands) {
    OneThread plan;
    plan.stops.want({at_step(3)});
    (void)plan.run([&](const PlanTalk::Heard&) { plan.talk->go_on(); });
    // Asked for at the stops, answered before the end.
    const auto told = plan.stops.news();
    ASSERT_TRUE(told && told->size() == 1);
    EXPECT_TRUE(told->front().set);
    EXPECT_GE(told->front().hits, 3u);
}

TEST(PlanTalk, ABreakpointThatDoesNotFitSaysWhy) {
    OneThread plan;
    talk::BreakpointOrder wrong = at_step(1);
    wrong.element = "stepp";
    plan.stops.want({wrong});
    (void)plan.run([&](const PlanTalk::Heard&) { plan.talk->go_on(); });
    const auto told = plan.stops.news();
    ASSERT_TRUE(told && told->size() == 1);
    EXPECT_FALSE(told->front().set);
    EXPECT_EQ(told->front().why, "the plan Count has no actor \"stepp\"; did you mean step?");
}

TEST(PlanTalk, WhatIsSetWhileItStandsIsDoneAndItStaysThere) {
    OneThread plan;
    plan.stops.want({at_step(1)});
    std::string why = "not asked";
    int stops = 0;
    const run::Ended ended = plan.run([&](const PlanTalk::Heard&) {
        ++stops;
        if (stops > 1) return plan.talk->go_on();
        plan.talk->ask_held(
            run::SetVariable{0, "n", plan::Value(int64_t{4})},
            [&](const Result<run::Reply>& reply) {
                why = reply.ok() ? "" : reply.error().what;
                EXPECT_TRUE(plan.talk->is_paused());
                plan.talk->go_on();
            },
            PlanTalk::Then::GoOn);
    });
    // n becomes 4 before its first step: that one gives 5, the second ends the plan.
    EXPECT_EQ(why, "");
    EXPECT_EQ(stops, 2);
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
}

TEST(PlanTalk, StepsFromABreakpointToTheNextActor) {
    OneThread plan;
    plan.stops.want({at_step(5)});
    std::vector<std::string> paused;
    (void)plan.run([&](const PlanTalk::Heard& heard) {
        const run::Where& where = heard.stepped ? *heard.stepped : heard.broken->where;
        paused.push_back(where.levels.back().actor);
        paused.size() == 1 ? plan.talk->step() : plan.talk->go_on();
    });
    EXPECT_EQ(paused, (std::vector<std::string>{"step", "wait", "step"}));
}

}  // namespace
}  // namespace vagus::serve
