// A plan in virtual time beside something that has time of its own (src/run/surroundings.hpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <thread>

#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/debugger.hpp"
#include "run/heard_events.hpp"
#include "run/surroundings.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/core.hpp"

namespace vagus {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

// Begins each `step`, says which events come at which instant, and keeps a log that the plan's
// lines go to as well.
class Clockwork final : public run::Surroundings {
public:
    explicit Clockwork(Duration step) : step_(step), next_(step) {}
    void at(Time time, std::vector<run::BusEvent> events) { events_[time] = std::move(events); }

    Time next() const override { return next_; }
    std::vector<run::BusEvent> begin() override {
        log.push_back("begin " + std::to_string(next_.count()));
        const auto found = events_.find(next_);
        next_ += step_;
        return found == events_.end() ? std::vector<run::BusEvent>() : found->second;
    }
    void emit(Time at, const run::BusEvent& event) override {
        log.push_back("emit " + event.name + " " + std::to_string(at.count()));
    }
    void end() override { log.push_back("end " + std::to_string((next_ - step_).count())); }

    std::vector<std::string> log;

private:
    Duration step_;
    Time next_;
    std::map<Time, std::vector<run::BusEvent>> events_;
};

class SurroundingsTest : public ::testing::Test {
protected:
    SurroundingsTest() { toolbox::add_core(library_); }

    // The plan's ends of actors and its events with their times, and what it emits, in the log.
    run::Ended run(std::string_view actors, Clockwork& clockwork, run::RunOptions options = {},
                   const std::string& toolboxes = "[]") {
        const std::string text = R"({ "format": "vagus-plan/1", "name": "P", "toolboxes": )" +
                                 toolboxes + R"(, "start": { "actor": "a" }, "actors": {)" +
                                 std::string(actors) + "}}";
        const plan::Checked checked =
            plan::check("p.plan.json", plan::OneText(text), library_.templates());
        EXPECT_TRUE(checked.ok()) << plan::format_findings_json(checked.findings);
        graph_ = plan::make_graph(checked);
        options.surroundings = &clockwork;
        options.on_trace = [&](const plan::TraceEvent& event) {
            const std::string at = " " + std::to_string(event.at.count());
            if (const auto* ended = std::get_if<plan::ActorEnded>(&event.what)) {
                clockwork.log.push_back(std::string(ended->actor) + at);
            } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
                clockwork.log.push_back(std::string(raised->supervisor) + at);
            } else if (std::holds_alternative<plan::PlanEnded>(event.what)) {
                clockwork.log.push_back("over" + at);
            }
        };
        return run::VirtualTime(graph_, library_, options).run();
    }

    run::CodeLibrary library_;
    plan::Graph graph_;
};

TEST_F(SurroundingsTest, AtOneInstantThePlanStandsBetweenBeginAndEnd) {
    Clockwork clockwork(1ms);
    // 1.5 ms lies between two steps; 3 ms on one.
    const auto ended = run(R"(
        "a": { "template": "Wait", "in": { "seconds": 0.0015 }, "states": { "Done": "b" } },
        "b": { "template": "Send", "in": { "event": "'go'" }, "states": { "Sent": "c" } },
        "c": { "template": "Wait", "in": { "seconds": 0.0015 }, "states": { "Done": "@terminate" } }
        )",
                           clockwork);
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
    EXPECT_THAT(clockwork.log, ElementsAre("begin 1000", "end 1000", "a 1500", "emit go 1500",
                                           "b 1500", "begin 2000", "end 2000", "begin 3000",
                                           "c 3000", "over 3000", "end 3000"));
}

TEST_F(SurroundingsTest, WhatBeginGivesIsHeardAtThatInstant) {
    Clockwork clockwork(1ms);
    clockwork.at(2ms, {{"other", {1}}, {"go", {7}}});
    const auto ended = run(R"(
        "a": { "template": "Receive", "in": { "event": "'go'" },
               "states": { "Received": "@terminate" } })",
                           clockwork);
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
    EXPECT_THAT(clockwork.log, ElementsAre("begin 1000", "end 1000", "begin 2000", "a 2000",
                                           "over 2000", "end 2000"));
}

// Waits for a, then at once for b.
class AThenB final : public run::Actor {
    void run(run::ActorContext& context) override {
        context.wait_event("a");
        context.wait_event("b");
    }
};

// Of several events of one instant none is lost to code that waits for one after the other.
TEST_F(SurroundingsTest, CodeHearsAllEventsOfAnInstantThatItWaitsForInTheirOrder) {
    library_.add("test", "",
                 {{.declared = {.name = "AThenB", .outcomes = {{"Done", ""}}},
                   .actor = [] { return std::make_unique<AThenB>(); }}});
    constexpr std::string_view kActor =
        R"("a": { "template": "AThenB", "states": { "Done": "@terminate" } })";
    Clockwork in_order(1ms);
    in_order.at(1ms, {{"a", {}}, {"other", {}}, {"b", {}}});
    run(kActor, in_order, {}, R"(["test"])");
    EXPECT_THAT(in_order.log, ElementsAre("begin 1000", "a 1000", "over 1000", "end 1000"));
    // What came before its time is over.
    Clockwork reversed(1ms);
    reversed.at(1ms, {{"b", {}}, {"a", {}}});
    reversed.at(2ms, {{"b", {}}});
    run(kActor, reversed, {}, R"(["test"])");
    EXPECT_THAT(reversed.log, ElementsAre("begin 1000", "end 1000", "begin 2000", "a 2000",
                                          "over 2000", "end 2000"));
}

TEST(HeardEvents, OfMoreThanTheLimitTheOldestIsLost) {
    run::HeardEvents heard;
    for (size_t i = 0; i <= run::kKeptEventsMax; ++i) heard.push({std::to_string(i), {}});
    EXPECT_EQ(heard.take("")->name, "1");
    EXPECT_EQ(heard.take(std::to_string(run::kKeptEventsMax))->name,
              std::to_string(run::kKeptEventsMax));
    EXPECT_FALSE(heard.take("").has_value());
}

// P21: what a supervisor hears ranks before what the actor hears, whichever came first.
TEST_F(SurroundingsTest, OfTwoEventsAtOneInstantTheSupervisorsWins) {
    Clockwork clockwork(1ms);
    clockwork.at(1ms, {{"go", {}}, {"stop", {}}});
    run(R"(
        "a": { "template": "Receive", "in": { "event": "'go'" },
               "states": { "Received": "@terminate" },
               "supervisors": { "s": { "template": "OnEvent", "in": { "event": "'stop'" },
                                       "events": { "Received": "@terminate" } } } })",
        clockwork);
    EXPECT_THAT(clockwork.log, ElementsAre("begin 1000", "s 1000", "over 1000", "end 1000"));
}

TEST_F(SurroundingsTest, MaxTimeComesBeforeTheInstantAtIt) {
    Clockwork clockwork(1ms);
    run::RunOptions options;
    options.max_time = 2ms;
    const auto ended = run(R"("a": { "template": "WaitForever" })", clockwork, options);
    EXPECT_TRUE(ended.timed_out);
    EXPECT_THAT(clockwork.log, ElementsAre("begin 1000", "end 1000", "over 2000"));
}

// A pause at an instant of both lets the surroundings come first when the run goes on.
TEST_F(SurroundingsTest, APauseDoesNotChangeTheOrder) {
    constexpr std::string_view kActors = R"("a": { "template": "Wait", "in": { "seconds": 0.002 },
                                                   "states": { "Done": "@terminate" } })";
    Clockwork straight(1ms);
    run(kActors, straight);
    Clockwork paused(1ms);
    run::Debugger debugger(graph_, run::Debugger::At::Run);
    ASSERT_TRUE(debugger.post(run::Pause{2ms}).ok());
    run::RunOptions options;
    options.debugger = &debugger;
    std::thread person([&debugger] {
        for (;;) {
            const auto report = debugger.wait_report(10s);
            if (!report || std::holds_alternative<run::RunOver>(*report)) return;
            if (!std::holds_alternative<run::Stopped>(*report)) continue;
            EXPECT_TRUE(debugger.post(run::Continue{}).ok());
        }
    });
    run(kActors, paused, options);
    person.join();
    EXPECT_EQ(paused.log, straight.log);
}

// The bus cannot carry it: the code that emits it fails (P27).
TEST_F(SurroundingsTest, WhatMayNotBeEmittedEndsThePlanWithItsSentence) {
    Clockwork clockwork(1ms);
    run::RunOptions options;
    options.may_emit = [](const run::BusEvent& event) -> Status {
        return Error{Code::NotFound, "no project has the event " + event.name};
    };
    const auto ended = run(R"("a": { "template": "Send", "in": { "event": "'go'" },
                                     "states": { "Sent": "@terminate" } })",
                           clockwork, options);
    EXPECT_EQ(ended.result, plan::PlanResult::Error);
    EXPECT_THAT(ended.message, ::testing::HasSubstr("no project has the event go"));
    EXPECT_THAT(clockwork.log, ElementsAre("over 0"));
}

}  // namespace
}  // namespace vagus
