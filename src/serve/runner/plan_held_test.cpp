// Events that wait while a plan is paused, as the runner tells of them: on one thread, as in a
// world.
#include "serve/runner/plan_held.hpp"

#include <gtest/gtest.h>

#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/surroundings.hpp"
#include "run/virtual_time.hpp"
#include "serve/json.hpp"
#include "serve/runner/plan_stops.hpp"
#include "toolbox/core.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;

// `a` waits for go, then `b` for on.
constexpr const char* kTwo = R"({
  "format": "vagus-plan/1", "name": "Two", "start": { "actor": "a" },
  "actors": {
    "a": { "template": "Receive", "in": { "event": "'go'" }, "states": { "Received": "b" } },
    "b": { "template": "Receive", "in": { "event": "'on'" },
           "states": { "Received": "@terminate" } }
  }
})";

// Sends go at its second millisecond; `meanwhile` arrives while the plan is paused.
class Bus final : public run::Surroundings {
public:
    std::vector<run::BusEvent> meanwhile;

    Time next() const override { return next_; }
    std::vector<run::BusEvent> begin() override {
        next_ += 1ms;
        if (next_ == 3ms) return {{"go", {}}};
        return {};
    }
    std::vector<run::BusEvent> arrived() override { return std::exchange(meanwhile, {}); }
    void emit(Time, const run::BusEvent&) override {}
    void end() override {}

private:
    Time next_ = 1ms;
};

// Runs the plan with a breakpoint at b; `when_paused` is called again and again while it is paused.
struct PausedPlan {
    PausedPlan() {
        toolbox::add_core(library);
        checked = plan::check("two.plan.json", files, library.templates());
        graph = plan::make_graph(checked);
        talk.emplace(graph);
        stops.want({{.number = 1, .plan = "two.plan.json", .element = "b"}});
    }
    run::Ended run(std::function<void()> when_paused) {
        run::RunOptions options;
        options.debugger = &talk->debugger();
        options.surroundings = &bus;
        options.max_time = 1s;
        talk->debugger().while_paused([this, when_paused = std::move(when_paused)] {
            (void)talk->hear();
            held.tend(*talk);
            news = held.tell(0.002, document) || news;
            if (talk->is_paused()) when_paused();
        });
        stops.tend(*talk);
        const run::Ended ended = run::VirtualTime(graph, library, options).run();
        (void)talk->hear();  // answers that came before the end
        return ended;
    }
    size_t count() const { return document["events"].size(); }

    plan::OneText files{kTwo};
    run::CodeLibrary library;
    plan::Checked checked;
    plan::Graph graph;
    Bus bus;
    std::optional<PlanTalk> talk;
    PlanStops stops;
    PlanHeld held;
    Json document;
    bool news = false;
};

TEST(PlanHeld, TellsWhatWaitsWithItsNodeAndArguments) {
    PausedPlan plan;
    plan.bus.meanwhile = {{"on", {3, -4}, 5}};
    plan.run([&] {
        if (plan.count() == 0) return;
        const Json& one = plan.document["events"][0];
        EXPECT_EQ(one["name"], "on");
        EXPECT_EQ(one["args"], Json::array({3, -4}));
        EXPECT_EQ(one["node"], 5);
        EXPECT_EQ(one["t"], 0.002);
        EXPECT_EQ(one["after"], 0.0);
        EXPECT_EQ(plan.document["more"], 0);
        plan.talk->go_on();
    });
    EXPECT_TRUE(plan.news);
}

TEST(PlanHeld, ThoseBeyondWhatIsShownAreCounted) {
    PausedPlan plan;
    plan.bus.meanwhile.assign(run::kHeldEventsMax + 2, {"other", {}});
    plan.run([&] {
        if (plan.count() == 0) return;
        EXPECT_EQ(plan.count(), kHeldShownMax);
        EXPECT_EQ(plan.document["more"], run::kHeldEventsMax - kHeldShownMax);
        EXPECT_EQ(plan.document["dropped"], 2);
        plan.talk->abort();
    });
}

TEST(PlanHeld, OneIsDroppedAndWithTheOtherThePlanSteps) {
    PausedPlan plan;
    plan.bus.meanwhile = {{"other", {}}, {"on", {}}};
    bool dropped = false;
    int steps = 0;
    std::string said;
    const run::Ended ended = plan.run([&] {
        if (plan.count() == 2 && !std::exchange(dropped, true)) {
            const uint64_t number = plan.document["events"][0]["number"];
            PlanHeld::act(*plan.talk, {.act = talk::HeldAct::Drop, .number = number},
                          [&](const auto& reply) { said += reply.ok() ? "d" : "-"; });
        }
        if (plan.count() == 1 && steps == 0) {
            ++steps;
            PlanHeld::act(*plan.talk, {.act = talk::HeldAct::Step},
                          [&](const auto& reply) { said += reply.ok() ? "s" : "-"; });
        }
    });
    EXPECT_EQ(said, "ds");
    // b has heard it and was the last: the plan is over before it could pause again.
    EXPECT_EQ(ended.result, plan::PlanResult::Ok);
}

TEST(PlanHeld, AStepWithoutAnEventIsRefusedAndThePlanStaysWhereItIs) {
    PausedPlan plan;
    std::string why;
    bool asked = false;
    plan.run([&] {
        if (!std::exchange(asked, true)) {
            PlanHeld::act(*plan.talk, {.act = talk::HeldAct::Step},
                          [&](const auto& reply) { why = reply.ok() ? "" : reply.error().what; });
        }
        if (why.empty()) return;
        EXPECT_TRUE(plan.talk->is_paused());
        plan.talk->abort();
    });
    EXPECT_EQ(why, "no event of the bus waits for the plan");
}

}  // namespace
}  // namespace vagus::serve
