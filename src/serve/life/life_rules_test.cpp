// The rules: every command is answered exactly once; after Stop nothing is let go until somebody
// asks; what was opened is closed.
#include <cstdlib>
#include <functional>
#include <random>

#include "base/rng.hpp"
#include "serve/life/test_life.hpp"

namespace vagus::serve {
namespace {

using namespace test;

// ---- the rules, over everything that can happen ----

// One input of each kind. Answers of nodes and runners are to what was asked last.
using Make = std::function<Input(Bench&)>;
const std::vector<Make>& inputs() {
    static const std::vector<Make> kInputs = {
        [](Bench&) { return Joined{}; },
        [](Bench& b) {
            return Open{b.call(), false};
        },
        [](Bench& b) {
            return Open{b.call(), true};
        },
        [](Bench& b) {
            return Start{b.call(), false, false};
        },
        [](Bench& b) {
            return Start{b.call(), false, true};
        },
        [](Bench& b) {
            return Start{b.call(), true, true};
        },
        [](Bench& b) {
            return Start{b.call(), true, false, false, true};
        },
        [](Bench& b) { return Start{b.call(), true, false, true, false, false, "Ann", false}; },
        [](Bench&) { return Opened{}; },
        [](Bench&) { return Failed{"it cannot"}; },
        [](Bench&) { return Described{}; },
        [](Bench& b) { return Loaded{b.load}; },
        [](Bench& b) { return Went{b.go}; },
        [](Bench&) { return Halted{}; },
        [](Bench& b) { return Pause{b.call()}; },
        [](Bench& b) {
            return NodesPaused{b.calls, ""};
        },
        [](Bench& b) { return HoldPlan{b.call()}; },
        [](Bench& b) { return ContinuePlan{b.call()}; },
        [](Bench& b) {
            return EndThePlan{b.call(), "Ann"};
        },
        [](Bench& b) { return StepInto{b.call()}; },
        [](Bench&) { return BreakpointsSet{}; },
        [](Bench&) { return PlanEnded{"OK"}; },
        [](Bench&) {
            return PlanEnded{"Error", "why"};
        },
        [](Bench&) { return Died{"killed"}; },
        [](Bench& b) {
            return Stop{b.call(), {"Ann"}};
        },
        [](Bench& b) {
            return Stopped{b.stop, stood()};
        },
        [](Bench& b) {
            return Leave{b.call(), {"Ann", Why::Target}, false};
        },
        [](Bench& b) {
            return Leave{b.call(), {"Ann", Why::Target}, true};
        },
    };
    return kInputs;
}

bool asks_for_a_run(const Input& input) {
    return std::holds_alternative<Start>(input) || std::holds_alternative<ContinuePlan>(input) ||
           std::holds_alternative<StepInto>(input) ||
           (std::holds_alternative<Open>(input) && std::get<Open>(input).go);
}

bool lets_run(const std::string& words) {
    for (const char* one : {"let-go", "begin", "continue", "step "}) {
        if (words.find(one) != std::string::npos) return true;
    }
    return false;
}

// A bus is joined only where nothing is connected: the server leaves one target first.
bool may_come(const Bench& bench, const Input& input) {
    return !std::holds_alternative<Joined>(input) || bench.life.state() == State::None;
}

void feed(Bench& bench, const Make& make, const std::string& where) {
    const Input input = make(bench);
    if (!may_come(bench, input)) return;
    if (asks_for_a_run(input)) bench.asked = true;
    if (std::holds_alternative<Stop>(input)) bench.asked = false;
    const std::string did = bench.take(input);
    EXPECT_TRUE(bench.asked || !lets_run(did)) << where << did;
    for (const auto& [call, times] : bench.answers) EXPECT_LE(times, 1) << where << call;
}

// Callers that still wait are answered by the end of everything: the nodes are silent, the pause is
// answered by the nodes or by leaving.
void finish(Bench& bench, const std::string& where) {
    bench.take(Leave{bench.call(), {"Ann", Why::Project}, true});
    bench.pass(kPlanEndsWithin);
    bench.pass(kReportWithin);
    for (const auto& [call, times] : bench.answers) {
        EXPECT_EQ(times, 1) << where << "command " << call;
    }
    EXPECT_FALSE(bench.runner) << where;
    EXPECT_EQ(bench.life.state(), State::None) << where;
    EXPECT_EQ(bench.life.next_tick(), Time::max()) << where;
}

// Ways to each of the states.
const std::vector<std::pair<State, std::function<void(Bench&)>>>& ways() {
    using Way = std::pair<State, std::function<void(Bench&)>>;
    static const std::vector<Way> kWays = {
        {State::None, [](Bench&) {}},
        {State::Opening,
         [](Bench& b) {
             b.take(Start{b.call(), true, true});
         }},
        {State::Opening, [](Bench& b) { b.take(Open{b.call()}); }},
        {State::Loading,
         [](Bench& b) {
             b.take(Start{b.call(), true, true});
             b.take(Opened{});
         }},
        {State::Loading,
         [](Bench& b) {
             b.run_world();
             b.take(Start{b.call()});
         }},
        {State::Ready, [](Bench& b) { b.take(Joined{}); }},
        {State::Running, [](Bench& b) { b.run_world(); }},
        {State::Running, [](Bench& b) { b.run_world(true); }},
        {State::Running, [](Bench& b) { b.run_bus_plan(); }},
        {State::Paused,
         [](Bench& b) {
             b.run_world();
             b.take(Halted{});
         }},
        {State::Stopping,
         [](Bench& b) {
             b.run_bus_plan();
             b.take(Stop{b.call(), {"Ann"}});
             b.asked = false;
         }},
        {State::Stopping,
         [](Bench& b) {
             b.run_world(true);
             b.take(Stop{b.call(), {"Ann"}});
             b.asked = false;
         }},
        {State::ComingToRest,
         [](Bench& b) {
             b.run_world();
             b.take(Stop{b.call(), {"Ann"}});
             b.asked = false;
             b.take(Stopped{b.stop, stood()});
         }},
        {State::Dead,
         [](Bench& b) {
             b.run_world();
             b.take(Died{"killed"});
         }},
    };
    return kWays;
}

TEST(LifeRules, HoldForAllPairsOfInputsInEveryState) {
    for (size_t way = 0; way < ways().size(); ++way) {
        for (size_t first = 0; first < inputs().size(); ++first) {
            for (size_t second = 0; second < inputs().size(); ++second) {
                const std::string where = "way " + std::to_string(way) + ", inputs " +
                                          std::to_string(first) + " and " + std::to_string(second) +
                                          ": ";
                Bench bench;
                ways()[way].second(bench);
                ASSERT_EQ(bench.life.state(), ways()[way].first) << where;
                feed(bench, inputs()[first], where);
                feed(bench, inputs()[second], where);
                finish(bench, where);
                ASSERT_FALSE(testing::Test::HasFailure()) << where;
            }
        }
    }
}

TEST(LifeRules, HoldForAnySequence) {
    const char* given = std::getenv("VAGUS_SEED");
    const uint64_t seed = given ? std::strtoull(given, nullptr, 10) : std::random_device()();
    SCOPED_TRACE("VAGUS_SEED=" + std::to_string(seed));
    SplitMix64 dice(seed);
    for (int round = 0; round < 3000; ++round) {
        Bench bench;
        const std::string where = "round " + std::to_string(round) + ": ";
        for (int step = 0; step < 60; ++step) {
            feed(bench, inputs()[dice.next() % inputs().size()], where);
            const std::string did =
                bench.pass(std::chrono::milliseconds(dice.next() % 700), dice.next() % 8 == 0);
            ASSERT_TRUE(bench.asked || !lets_run(did)) << where << did;
        }
        finish(bench, where);
        ASSERT_FALSE(testing::Test::HasFailure()) << where;
    }
}

}  // namespace
}  // namespace vagus::serve
