// Events of the bus that come while a plan is paused in its debugger (decision 0131): in virtual
// time beside something that has time of its own, and in real time from another thread.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <set>
#include <thread>

#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/debugger.hpp"
#include "run/real_time.hpp"
#include "run/surroundings.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/core.hpp"

namespace vagus {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Waits for `go`, then for `on`, then for `end`.
constexpr std::string_view kThree = R"(
    "a": { "template": "Receive", "in": { "event": "'go'" }, "states": { "Received": "b" } },
    "b": { "template": "Receive", "in": { "event": "'on'" }, "states": { "Received": "c" } },
    "c": { "template": "Receive", "in": { "event": "'end'" },
           "states": { "Received": "@terminate" } })";

// Says which events come at which millisecond, and which have arrived while the plan is paused.
class Clockwork final : public run::Surroundings {
public:
    std::map<Time, std::vector<run::BusEvent>> events;
    std::vector<run::BusEvent> meanwhile;

    Time next() const override { return next_; }
    std::vector<run::BusEvent> begin() override {
        const auto found = events.find(next_);
        next_ += 1ms;
        return found == events.end() ? std::vector<run::BusEvent>() : found->second;
    }
    std::vector<run::BusEvent> arrived() override { return std::exchange(meanwhile, {}); }
    void emit(Time, const run::BusEvent&) override {}
    void end() override {}

private:
    Time next_ = 1ms;
};

// A plan with its debugger, asked from the test's thread.
class HeldTest : public ::testing::Test {
protected:
    HeldTest() { toolbox::add_core(library_); }
    ~HeldTest() override {
        if (!runner_.joinable()) return;
        (void)debugger_->post(run::Abort{}).ok();
        runner_.join();
    }

    void make(std::string_view actors, const std::string& toolboxes = "[]") {
        const std::string text = R"({ "format": "vagus-plan/1", "name": "P", "toolboxes": )" +
                                 toolboxes + R"(, "start": { "actor": "a" }, "actors": {)" +
                                 std::string(actors) + "}}";
        checked_ = plan::check("p.plan.json", plan::OneText(text), library_.templates());
        EXPECT_TRUE(checked_.ok()) << plan::format_findings_json(checked_.findings);
        graph_ = plan::make_graph(checked_);
        debugger_ = std::make_unique<run::Debugger>(graph_, run::Debugger::At::Start);
        options_.debugger = debugger_.get();
        options_.max_time = 10min;
        options_.on_trace = [this](const plan::TraceEvent& event) {
            const auto* ended = std::get_if<plan::ActorEnded>(&event.what);
            if (ended)
                ends_ += std::string(ended->actor) + " " + std::to_string(event.at / 1ms) + ";";
        };
    }
    void start_virtual(std::string_view actors) {
        make(actors);
        options_.surroundings = &clockwork_;
        runner_ = std::thread([this] { run::VirtualTime(graph_, library_, options_).run(); });
        (void)next_stop();
    }
    void start_real(std::string_view actors, const std::string& toolboxes = "[]") {
        make(actors, toolboxes);
        real_ = std::make_unique<run::RealTime>(graph_, library_, options_);
        runner_ = std::thread([this] { real_->run(); });
        (void)next_stop();
    }

    Result<run::Reply> ask(run::Request request) {
        const uint64_t number = debugger_->post(std::move(request)).value();
        for (;;) {
            run::Report report = next();
            auto* answer = std::get_if<run::Answer>(&report);
            if (answer && answer->request == number) return answer->reply;
            if (!answer) later_.push_back(std::move(report));
        }
    }
    std::string say(run::Request request) {
        const auto reply = ask(std::move(request));
        return reply.ok() ? "done" : reply.error().what;
    }
    run::HeldNow held() { return std::get<run::HeldNow>(ask(run::ListHeld{}).value()); }
    std::vector<std::string> names() {
        std::vector<std::string> all;
        for (const run::HeldEvent& one : held().events) all.push_back(one.event.name);
        return all;
    }
    run::Stopped next_stop() {
        run::Report report = later_.empty() ? next() : std::move(later_.front());
        if (!later_.empty()) later_.erase(later_.begin());
        return std::get<run::Stopped>(std::move(report));
    }
    run::Stopped go_on() {
        EXPECT_EQ(say(run::Continue{}), "done");
        return next_stop();
    }
    std::string finish() {
        EXPECT_EQ(say(run::Continue{}), "done");
        runner_.join();
        return ends_;
    }
    static std::string actor_at(const run::Stopped& stopped) {
        return stopped.where.levels.back().actor;
    }
    void break_at(const std::string& actor) {
        EXPECT_TRUE(ask(run::AddBreakpoint{{.element = actor}}).ok());
    }

    run::CodeLibrary library_;
    Clockwork clockwork_;
    std::unique_ptr<run::RealTime> real_;
    std::string ends_;  // "a 3;": that actor at that millisecond; when the run is over

private:
    run::Report next() {
        for (;;) {
            if (auto report = debugger_->wait_report(1s)) return *report;
        }
    }

    plan::Checked checked_;
    plan::Graph graph_;
    run::RunOptions options_;
    std::unique_ptr<run::Debugger> debugger_;
    std::vector<run::Report> later_;
    std::thread runner_;
};

// ---- in virtual time ----

TEST_F(HeldTest, WhatArrivesWhileThePlanStandsWaitsAndIsHeardInItsOrder) {
    clockwork_.events[2ms] = {{"go", {}}};
    clockwork_.events[4ms] = {{"end", {}}};
    start_virtual(kThree);
    break_at("b");
    EXPECT_EQ(go_on().where.at, 2ms);
    EXPECT_THAT(names(), IsEmpty());
    clockwork_.meanwhile = {{"on", {7, -1}, 3}};
    const run::HeldNow now = held();
    ASSERT_EQ(now.events.size(), 1u);
    EXPECT_EQ(now.events[0].event.name, "on");
    EXPECT_THAT(now.events[0].event.arguments, ElementsAre(7, -1));
    EXPECT_EQ(now.events[0].event.from, 3);
    // Heard at the next millisecond, as without a debugger.
    EXPECT_EQ(finish(), "a 2;b 3;c 4;");
}

TEST_F(HeldTest, WhatNobodyLooksAtIsHeardAsWithoutADebugger) {
    clockwork_.events = {{2ms, {{"go", {}}}}, {3ms, {{"on", {}}}}, {4ms, {{"end", {}}}}};
    start_virtual(kThree);
    break_at("b");
    (void)go_on();
    EXPECT_EQ(finish(), "a 2;b 3;c 4;");
}

TEST_F(HeldTest, OneThatIsDroppedIsNeverHeard) {
    clockwork_.events = {{2ms, {{"go", {}}}}, {5ms, {{"on", {}}}}, {6ms, {{"end", {}}}}};
    start_virtual(kThree);
    break_at("b");
    (void)go_on();
    clockwork_.meanwhile = {{"on", {1}}, {"other", {}}};
    const uint64_t first = held().events.at(0).number;
    EXPECT_EQ(say(run::DropHeld{first}), "done");
    EXPECT_THAT(names(), ElementsAre("other"));
    EXPECT_EQ(say(run::DropHeld{first}),
              "that event does not wait any more: it was let go or dropped");
    EXPECT_EQ(finish(), "a 2;b 5;c 6;");
}

TEST_F(HeldTest, AllCanBeDroppedAtOnce) {
    clockwork_.events = {{2ms, {{"go", {}}}}, {5ms, {{"on", {}}}}, {6ms, {{"end", {}}}}};
    start_virtual(kThree);
    break_at("b");
    (void)go_on();
    clockwork_.meanwhile = {{"on", {}}, {"end", {}}};
    EXPECT_EQ(held().events.size(), 2u);
    EXPECT_EQ(say(run::DropHeld{}), "done");
    EXPECT_THAT(names(), IsEmpty());
    EXPECT_EQ(finish(), "a 2;b 5;c 6;");
}

// `end` came first and would be past when c waits for it; let go after `on` it is heard.
TEST_F(HeldTest, OneThatIsLetGoIsHeardBeforeAllOthers) {
    clockwork_.events[2ms] = {{"go", {}}};
    clockwork_.events[9ms] = {{"end", {}}};
    start_virtual(kThree);
    break_at("b");
    (void)go_on();
    clockwork_.meanwhile = {{"other", {}}, {"on", {}}};
    EXPECT_EQ(say(run::LetGo{held().events.at(1).number}), "done");
    EXPECT_THAT(names(), ElementsAre("other"));
    EXPECT_EQ(say(run::LetGo{}), "done");
    EXPECT_THAT(names(), IsEmpty());
    EXPECT_EQ(finish(), "a 2;b 3;c 9;");
}

TEST_F(HeldTest, AStepWithOneEventStopsAtTheNextThingThePlanDoesAndHoldsTheOthers) {
    clockwork_.events[2ms] = {{"go", {}}};
    clockwork_.events[3ms] = {{"end", {}}};  // comes in the middle of the step
    start_virtual(kThree);
    break_at("b");
    (void)go_on();
    clockwork_.meanwhile = {{"on", {}}};
    EXPECT_EQ(held().events.size(), 1u);
    EXPECT_EQ(say(run::StepEvent{}), "done");
    const run::Stopped stopped = next_stop();
    EXPECT_EQ(stopped.why, run::Stopped::Why::Step);
    EXPECT_EQ(stopped.where.at, 3ms);
    EXPECT_EQ(actor_at(stopped), "c");  // b has ended
    EXPECT_THAT(names(), ElementsAre("end"));
    EXPECT_EQ(finish(), "a 2;b 3;c 4;");
}

// Nothing comes of it: the plan is paused again 100 ms later, before anything that is due then.
TEST_F(HeldTest, AStepOfWhichNothingComesEnds) {
    clockwork_.events[2ms] = {{"go", {}}};
    clockwork_.events[50ms] = {{"on", {}}};
    clockwork_.events[200ms] = {{"end", {}}};
    start_virtual(kThree);
    break_at("b");
    (void)go_on();
    EXPECT_EQ(say(run::StepEvent{}), "no event of the bus waits for the plan");
    clockwork_.meanwhile = {{"other", {}}};
    EXPECT_EQ(say(run::StepEvent{}), "done");
    const run::Stopped stopped = next_stop();
    EXPECT_EQ(stopped.where.at, 102ms);
    EXPECT_THAT(names(), ElementsAre("on"));
    EXPECT_EQ(finish(), "a 2;b 102;c 200;");
}

TEST_F(HeldTest, OnlyAPlanThatStandsHasThem) {
    start_real(kThree);
    EXPECT_EQ(say(run::Continue{}), "done");
    for (const run::Request& request : {run::Request(run::LetGo{}), run::Request(run::DropHeld{}),
                                        run::Request(run::StepEvent{})}) {
        EXPECT_EQ(say(request), "the plan runs; pause it first");
    }
    EXPECT_THAT(names(), IsEmpty());
}

TEST_F(HeldTest, OfTooManyTheNewestAreDroppedAndCounted) {
    clockwork_.events[2ms] = {{"go", {}}};
    start_virtual(kThree);
    break_at("b");
    (void)go_on();
    for (size_t i = 0; i < run::kHeldEventsMax; ++i) clockwork_.meanwhile.push_back({"other", {}});
    clockwork_.meanwhile.push_back({"on", {}});
    const run::HeldNow now = held();
    EXPECT_EQ(now.events.size(), run::kHeldEventsMax);
    EXPECT_EQ(now.events.back().event.name, "other");
    EXPECT_EQ(now.dropped, 1u);
}

// ---- in real time ----

TEST_F(HeldTest, InRealTimeAStepHandsOverOneAndHoldsTheOthers) {
    start_real(kThree);
    EXPECT_EQ(say(run::Step{}), "done");
    EXPECT_EQ(actor_at(next_stop()), "a");
    for (const char* name : {"other", "go", "on"}) real_->hear({name, {}, 1});
    EXPECT_THAT(names(), ElementsAre("other", "go", "on"));
    EXPECT_EQ(say(run::DropHeld{held().events.at(0).number}), "done");
    // a has not begun: it begins, hears go and ends, or the time of a step is over before.
    EXPECT_EQ(say(run::StepEvent{}), "done");
    EXPECT_EQ(next_stop().why, run::Stopped::Why::Step);
    EXPECT_THAT(names(), ElementsAre("on"));
    real_->hear({"end", {}});
    EXPECT_THAT(names(), ElementsAre("on", "end"));
}

// It was about to begin, and begins first.
TEST_F(HeldTest, InRealTimeAnActorThatWasAboutToBeginHearsWhatCameMeanwhile) {
    start_real(R"("a": { "template": "Receive", "in": { "event": "'go'" },
        "states": { "Received": "@terminate" } })");
    EXPECT_EQ(say(run::Step{}), "done");
    EXPECT_EQ(actor_at(next_stop()), "a");
    real_->hear({"go", {}});
    EXPECT_EQ(held().events.size(), 1u);
    EXPECT_EQ(finish().substr(0, 2), "a ");
}

// Notes the names of all that it hears, until end.
class Collects final : public run::Actor {
public:
    struct Seen {
        std::atomic<bool> listens = false;
        std::vector<std::string> names;
    };
    explicit Collects(Seen& seen) : seen_(seen) {}
    void run(run::ActorContext& context) override {
        context.listen({"one", "two", "three", "end"});
        seen_.listens = true;
        while (seen_.names.empty() || seen_.names.back() != "end") {
            seen_.names.push_back(context.next_event(run::kNever)->name);
        }
        context.end(0);
    }

private:
    Seen& seen_;
};

TEST_F(HeldTest, InRealTimeAllGoInTheirOrderWithThePlan) {
    Collects::Seen seen;
    library_.add("test", "",
                 {{.declared = {.name = "Collects", .outcomes = {{"Done", ""}}},
                   .actor = [&seen] { return std::make_unique<Collects>(seen); }}});
    start_real(R"("a": { "template": "Collects", "states": { "Done": "@terminate" } })",
               R"(["test"])");
    EXPECT_EQ(say(run::Continue{}), "done");
    while (!seen.listens) std::this_thread::yield();
    EXPECT_EQ(say(run::Pause{}), "done");
    (void)next_stop();
    for (const char* name : {"one", "two", "three", "end"}) real_->hear({name, {}});
    EXPECT_EQ(say(run::LetGo{held().events.at(1).number}), "done");
    EXPECT_EQ(say(run::DropHeld{held().events.at(0).number}), "done");
    (void)finish();
    EXPECT_THAT(seen.names, ElementsAre("two", "three", "end"));
}

TEST_F(HeldTest, InRealTimeOfTooManyTheNewestAreDroppedAndCounted) {
    start_real(kThree);
    EXPECT_EQ(say(run::Step{}), "done");
    (void)next_stop();
    for (size_t i = 0; i < run::kHeldEventsMax + 3; ++i) real_->hear({"other", {}});
    EXPECT_EQ(held().events.size(), run::kHeldEventsMax);
    EXPECT_EQ(held().dropped, 3u);
}

}  // namespace
}  // namespace vagus
