// What always holds, over plans made at random (docs/plans.md, P14, P17, P18, P20, P23).
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/real_time.hpp"
#include "run/virtual_time.hpp"
#include "tests/plans/random_plan.hpp"
#include "tests/plans/trace_rules.hpp"
#include "toolbox/core.hpp"

namespace vagus {
namespace {

using namespace std::chrono_literals;

uint64_t first_seed() {
    const char* seed = std::getenv("VAGUS_SEED");
    return seed ? std::strtoull(seed, nullptr, 10) : 1;
}

uint64_t long_or(uint64_t usual, uint64_t when_long) {
    return std::getenv("VAGUS_LONG") ? when_long : usual;
}

std::string virtual_trace(const plan::Graph& graph, const run::CodeLibrary& library,
                          TraceRules& rules) {
    std::string lines;
    uint64_t events = 0;
    run::VirtualTime* running = nullptr;
    run::RunOptions options;
    options.max_time = 2s;
    options.on_trace = [&](const plan::TraceEvent& event) {
        rules.see(event);
        lines += plan::format_trace(event) + "\n";
        if (++events == 3000) running->abort();  // many random plans have loops that take no time
    };
    run::VirtualTime run(graph, library, options);
    running = &run;
    run.run();
    return lines;
}

TEST(RandomPlans, KeepTheRulesInVirtualTimeAndRunTheSameTwice) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    const uint64_t first = first_seed();
    std::cout << "seeds from " << first << "\n";
    for (uint64_t seed = first; seed < first + long_or(300, 20'000); ++seed) {
        const RandomPlans plans(seed);
        const plan::Checked checked = plan::check("main.plan.json", plans, library.templates());
        ASSERT_TRUE(checked.ok()) << "seed " << seed << "\n"
                                  << plan::format_findings_json(checked.findings);
        const plan::Graph graph = plan::make_graph(checked);
        TraceRules rules(graph), again(graph);
        const std::string trace = virtual_trace(graph, library, rules);
        ASSERT_EQ(rules.finish(), std::vector<std::string>()) << "seed " << seed << "\n" << trace;
        ASSERT_EQ(virtual_trace(graph, library, again), trace) << "seed " << seed;
    }
}

// Counts itself: every supervisor that was made must be gone when the run is over.
class Counted final : public run::Supervisor {
public:
    explicit Counted(std::atomic<int>& alive) : alive_(alive) { ++alive_; }
    ~Counted() override { --alive_; }
    std::optional<plan::Given> check(const run::Check& check) override {
        if (check.event->name != "go") return std::nullopt;
        return plan::Given{};
    }

private:
    std::atomic<int>& alive_;
};

constexpr std::string_view kBackAndForth = R"({
  "format": "vagus-plan/1",
  "name": "BackAndForth",
  "toolboxes": ["counted"],
  "start": { "actor": "a" },
  "actors": {
    "a": { "template": "WaitForever", "supervisors": {
      "go": { "template": "OnGo", "events": { "Go": "b" } } } },
    "b": { "template": "Wait", "in": { "seconds": 1000 }, "states": { "Done": "@terminate" },
      "supervisors": { "go2": { "template": "OnGo", "events": { "Go": "a" } } } }
  }
})";

TEST(RealTime, TwentyThousandInterruptionsLeaveNothingBehind) {
    std::atomic<int> alive = 0;
    run::CodeLibrary library;
    toolbox::add_core(library);
    run::Coded on_go;
    on_go.declared.name = "OnGo";
    on_go.declared.kind = plan::Kind::Supervisor;
    on_go.declared.outcomes = {{.name = "Go"}};
    on_go.declared.period_ms = 0;
    on_go.supervisor = [&alive] { return std::make_unique<Counted>(alive); };
    library.add("counted", "", {on_go});
    const plan::OneText file(kBackAndForth);
    const plan::Checked checked = plan::check("b.plan.json", file, library.templates());
    ASSERT_TRUE(checked.ok()) << plan::format_findings_json(checked.findings);
    const plan::Graph graph = plan::make_graph(checked);

    const uint64_t wanted = long_or(20'000, 1'000'000);
    uint64_t interrupted = 0;
    TraceRules rules(graph);
    run::RealTime* running = nullptr;
    run::RunOptions options;
    options.on_trace = [&](const plan::TraceEvent& event) {
        rules.see(event);
        if (std::holds_alternative<plan::ActorStarted>(event.what)) running->hear({"go", {}});
        if (!std::holds_alternative<plan::ActorInterrupted>(event.what)) return;
        if (++interrupted == wanted) running->abort();
    };
    run::RealTime real(graph, library, options);
    running = &real;
    const run::Ended ended = real.run();

    EXPECT_EQ(ended.result, plan::PlanResult::Interrupted);
    EXPECT_GE(interrupted, wanted);
    EXPECT_EQ(rules.finish(), std::vector<std::string>());
    EXPECT_EQ(alive.load(), 0);
}

TEST(RealTime, RandomPlansKeepTheRules) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    const uint64_t first = first_seed();
    std::cout << "seeds from " << first << "\n";
    for (uint64_t seed = first; seed < first + long_or(15, 500); ++seed) {
        const RandomPlans plans(seed);
        const plan::Checked checked = plan::check("main.plan.json", plans, library.templates());
        const plan::Graph graph = plan::make_graph(checked);
        TraceRules rules(graph);
        uint64_t events = 0;
        run::RealTime* running = nullptr;
        run::RunOptions options;
        options.max_time = 300ms;
        options.on_trace = [&](const plan::TraceEvent& event) {
            rules.see(event);
            if (++events == 20'000) running->abort();
        };
        run::RealTime real(graph, library, options);
        running = &real;
        real.run();
        ASSERT_EQ(rules.finish(), std::vector<std::string>()) << "seed " << seed;
    }
}

}  // namespace
}  // namespace vagus
