// Rules P14 to P23 of docs/plans.md that need a clock: when checks come, and who is first of those
// that are due at one instant. The times were worked out by hand.
#include "run/virtual_time.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/test_plans.hpp"

namespace vagus::run {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

// Raises as soon as it has watched so long; notes when it is asked.
class After final : public Supervisor {
public:
    After(Duration time, std::vector<Duration>& checks) : time_(time), checks_(checks) {}
    std::optional<plan::Given> check(const Check& check) override {
        checks_.push_back(check.since_start);
        if (check.since_start < time_) return std::nullopt;
        return plan::Given{};
    }

private:
    Duration time_;
    std::vector<Duration>& checks_;
};

class VirtualRun : public testing::Test {
protected:
    VirtualRun() {
        const auto sleeps = [this](std::string name, Duration time) {
            return test_actor(std::move(name), [this, time](ActorContext& context) {
                ++begun_;
                context.sleep(time);
            });
        };
        const auto after = [this](std::string name, int64_t period_ms, Duration time) {
            return test_supervisor(std::move(name), period_ms,
                                   [this, time] { return std::make_unique<After>(time, checks_); });
        };
        library_.add("core", "",
                     {sleeps("Sleep20", 20ms), sleeps("Sleep25", 25ms), sleeps("Forever", kNever),
                      test_actor("Lingers",
                                 [](ActorContext& context) {
                                     try {
                                         context.sleep(kNever);
                                     } catch (const Stop&) {
                                         context.linger(5ms);
                                         throw;
                                     }
                                 }),
                      test_actor("Draws",
                                 [](ActorContext& context) {
                                     context.sleep(std::chrono::microseconds(
                                         1 + context.random().below(1000)));
                                 }),
                      after("AtOnce", 10, 0ms), after("At20", 10, 20ms), after("Every7", 7, 15ms),
                      after("Never", 10, kNever)});
    }

    // With its time in milliseconds: "20 event wall".
    std::vector<std::string> run(const std::string& start, const std::string& actors) {
        const std::string text = R"({ "format": "vagus-plan/1", "name": "Test", "start": {)" +
                                 start + R"(}, "actors": {)" + actors + "}}";
        const plan::Graph graph = test_graph(text, library_);
        std::vector<std::string> lines;
        options_.on_trace = [&lines](const plan::TraceEvent& event) {
            lines.push_back(fmt::format("{} {}", static_cast<double>(event.at.count()) / 1000,
                                        test_line(event)));
        };
        VirtualTime virtual_time(graph, library_, options_);
        ended_ = virtual_time.run();
        return lines;
    }

    CodeLibrary library_;
    RunOptions options_;
    Ended ended_;
    std::vector<Duration> checks_;  // since the start of their watching
    int begun_ = 0;
};

constexpr const char* kBehind =
    R"("b": { "template": "Sleep20", "states": { "Done": "@terminate" } })";

TEST_F(VirtualRun, ChecksComeAtTheStartAndAtMultiplesOfThePeriod) {  // P22
    EXPECT_THAT(run(R"("actor": "a")",
                    R"("a": { "template": "Sleep25", "states": { "Done": "@terminate" },
                       "supervisors": {
                         "s": { "template": "Never", "events": { "Seen": "a" } } } })"),
                ElementsAre("0 plan-start", "0 actor-start a", "25 actor-end a", "25 plan-end"));
    EXPECT_THAT(checks_, ElementsAre(0ms, 10ms, 20ms));
    EXPECT_EQ(exit_status(ended_), 0);
}

TEST_F(VirtualRun, AGlobalOneKeepsItsCountFromActorToActor) {  // P22
    run(R"("actor": "a", "supervisors": {
          "s": { "template": "Never", "events": { "Seen": "a" } } })",
        R"("a": { "template": "Sleep25", "states": { "Done": "b" } },)" + std::string(kBehind));
    EXPECT_THAT(checks_, ElementsAre(0ms, 10ms, 20ms, 30ms, 40ms));
}

TEST_F(VirtualRun, AnEventAtTheFirstCheckComesBeforeTheCode) {  // P16
    EXPECT_THAT(
        run(R"("actor": "a")",
            R"("a": { "template": "Forever", "states": { "Done": "@terminate" }, "supervisors": {
                 "s": { "template": "AtOnce", "events": { "Seen": "b" } } } },)" +
                std::string(kBehind)),
        ElementsAre("0 plan-start", "0 event s", "0 interrupted a", "0 actor-start b",
                    "20 actor-end b", "20 plan-end"));
    EXPECT_EQ(begun_, 1);  // b alone
}

TEST_F(VirtualRun, OfWhatIsDueAtOneInstantTheActorsEndIsTheLast) {  // P21
    EXPECT_THAT(
        run(R"("actor": "a")",
            R"("a": { "template": "Sleep20", "states": { "Done": "@terminate" }, "supervisors": {
                 "first": { "template": "At20", "events": { "Seen": "b" } },
                 "second": { "template": "At20", "events": { "Seen": "a" } } } },)" +
                std::string(kBehind)),
        ElementsAre("0 plan-start", "0 actor-start a", "20 event first", "20 interrupted a",
                    "20 actor-start b", "40 actor-end b", "40 plan-end"));
}

TEST_F(VirtualRun, GlobalSupervisorsComeBeforeTheActorsOwn) {  // P21
    const auto lines = run(
        R"("actor": "a", "supervisors": {
             "all": { "template": "At20", "events": { "Seen": "@terminate" } } })",
        R"("a": { "template": "Sleep20", "states": { "Done": "@terminate" }, "supervisors": {
             "own": { "template": "At20", "events": { "Seen": "a" } } } })");
    EXPECT_THAT(lines, ElementsAre("0 plan-start", "0 actor-start a", "20 event all",
                                   "20 interrupted a", "20 plan-end"));
    EXPECT_EQ(ended_.result, plan::PlanResult::Interrupted);
}

// Whoever asks hears each event before it is taken, and whether it has rivals; without the first
// the second one wins, and without both the actor ends.
TEST_F(VirtualRun, AnEventThatIsPassedOverHasNotHappened) {  // P21
    const std::string plan =
        R"("a": { "template": "Sleep20", "states": { "Done": "@terminate" }, "supervisors": {
             "first": { "template": "At20", "events": { "Seen": "b" } },
             "second": { "template": "At20", "events": { "Seen": "b" } } } },)" +
        std::string(kBehind);
    std::vector<std::string> asked;
    const auto without = [&](std::vector<std::string_view> passed) {
        options_.passes_over = [&asked, passed](const Raising& raising) {
            asked.push_back(fmt::format("{} {}{}", raising.plan, raising.supervisor,
                                        raising.tied ? ", tied" : ""));
            return std::find(passed.begin(), passed.end(), raising.supervisor) != passed.end();
        };
        return run(R"("actor": "a")", plan);
    };
    EXPECT_THAT(without({}), testing::Contains("20 event first"));
    EXPECT_THAT(asked, ElementsAre("Test first, tied"));
    EXPECT_THAT(without({"first"}), testing::Contains("20 event second"));
    EXPECT_THAT(without({"first", "second"}), testing::Contains("20 actor-end a"));
}

TEST_F(VirtualRun, TheNextActorWaitsUntilTheCodeHasStopped) {  // P14, P22: 21 is the third check
    EXPECT_THAT(
        run(R"("actor": "a")",
            R"("a": { "template": "Lingers", "states": { "Done": "@terminate" }, "supervisors": {
                 "s": { "template": "Every7", "events": { "Seen": "b" } } } },)" +
                std::string(kBehind)),
        ElementsAre("0 plan-start", "0 actor-start a", "21 event s", "26 interrupted a",
                    "26 actor-start b", "46 actor-end b", "46 plan-end"));
}

TEST_F(VirtualRun, TheEndOfItsTimeInterruptsIt) {
    options_.max_time = 30ms;
    EXPECT_THAT(run(R"("actor": "a")",
                    R"("a": { "template": "Forever", "states": { "Done": "@terminate" } })"),
                testing::Contains("30 interrupted a"));
    EXPECT_TRUE(ended_.timed_out);
}

TEST_F(VirtualRun, IsTheSameEachTimeAndAnotherWithAnotherSeed) {  // P21a
    const auto draw = [this](uint64_t seed) {
        options_.seed = seed;
        return run(R"("actor": "a")",
                   R"("a": { "template": "Draws", "states": { "Done": "@terminate" } })");
    };
    const auto first = draw(1);
    EXPECT_EQ(draw(1), first);
    EXPECT_NE(draw(2), first);
}

// Two plans on one clock, "One" and "Two", with their times in milliseconds: "20 Two actor-end a".
class VirtualRuns : public VirtualRun {
protected:
    std::vector<std::string> run_in_turn(const std::string& actors_of_one,
                                         const std::string& actors_of_two) {
        const auto graph_of = [this](const std::string& name, const std::string& actors) {
            return test_graph(R"({ "format": "vagus-plan/1", "name": ")" + name +
                                  R"(", "start": { "actor": "a" }, "actors": {)" + actors + "}}",
                              library_);
        };
        const plan::Graph one = graph_of("One", actors_of_one);
        const plan::Graph two = graph_of("Two", actors_of_two);
        std::vector<std::string> lines;
        options_.on_trace = [&lines](const plan::TraceEvent& event) {
            lines.push_back(fmt::format("{} {} {}", event.at / 1ms, event.plan, test_line(event)));
        };
        VirtualTime first(one, library_, options_), second(two, library_, options_);
        first.start();
        second.start();
        while (!first.over() || !second.over()) {
            const bool is_first = second.over() || (!first.over() && first.now() <= second.now());
            (is_first ? first : second).step();
        }
        first.finish();
        second.finish();
        return lines;
    }
};

// One sleeps 25 ms, the other 20 ms and then 20 ms again: the lines of both in the order of time.
TEST_F(VirtualRuns, OnOneClockAreTakenInTurn) {
    EXPECT_THAT(run_in_turn(R"("a": { "template": "Sleep25", "states": { "Done": "@terminate" } })",
                            R"("a": { "template": "Sleep20", "states": { "Done": "b" } },)" +
                                std::string(kBehind)),
                ElementsAre("0 One plan-start", "0 Two plan-start", "0 One actor-start a",
                            "0 Two actor-start a", "20 Two actor-end a", "20 Two actor-start b",
                            "25 One actor-end a", "25 One plan-end", "40 Two actor-end b",
                            "40 Two plan-end"));
}

// Both linger for 5 ms in a catch block: the first one leaves it while the other is still there.
TEST_F(VirtualRuns, PutThingsInOrderSideBySide) {  // P14, P27
    EXPECT_THAT(
        run_in_turn(
            R"("a": { "template": "Lingers", "states": { "Done": "@terminate" }, "supervisors": {
                 "s": { "template": "At20", "events": { "Seen": "@terminate" } } } })",
            R"("a": { "template": "Lingers", "states": { "Done": "@terminate" }, "supervisors": {
                 "s": { "template": "Every7", "events": { "Seen": "@terminate" } } } })"),
        ElementsAre("0 One plan-start", "0 Two plan-start", "0 One actor-start a",
                    "0 Two actor-start a", "20 One event s", "21 Two event s",
                    "25 One interrupted a", "25 One plan-end", "26 Two interrupted a",
                    "26 Two plan-end"));
}

}  // namespace
}  // namespace vagus::run
