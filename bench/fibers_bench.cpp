// Plans of many short actors in virtual time: what an actor costs, and each of its waits.
//
//     build/release/bin/bench_fibers      `figure:` lines: an activation, a wait
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/core.hpp"

namespace {

using namespace vagus;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kActors = 100;
constexpr int kRounds = 2'000;
constexpr int64_t kWaits = 500'000;

// Actors that each wait a millisecond, one after the other, in so many rounds.
std::string rounds() {
    std::string text = fmt::format(
        R"({{"format":"vagus-plan/1","name":"Short",
        "configuration":{{"round":{{"type":"int","initial":0}}}},"start":{{"actor":"next"}},
        "actors":{{"next":{{"template":"For","in":{{"counter":"round","last":"{}"}},
        "out":{{"counter":"round"}},"states":{{"Loop":"a1","Done":"@terminate"}}}})",
        kRounds - 1);
    for (int i = 1; i <= kActors; ++i) {
        const std::string then = i < kActors ? fmt::format("a{}", i + 1) : "next";
        text += fmt::format(
            R"(,"a{}":{{"template":"Wait","in":{{"seconds":"0.001"}},"states":{{"Done":"{}"}}}})",
            i, then);
    }
    return text + "}}";
}

class Waits final : public run::Actor {
    void run(run::ActorContext& context) override {
        for (int64_t i = 0; i < kWaits; ++i) context.sleep(1ms);
        context.end(0);
    }
};

// Of a plan that takes virtual time `count` times: real nanoseconds for each.
double run_of(const std::string& text, const run::CodeLibrary& library, int64_t count) {
    const plan::OneText file(text);
    const plan::Checked checked = plan::check("short.plan.json", file, library.templates());
    if (!checked.ok()) {
        fmt::print(stderr, "{}\n", plan::format_findings_json(checked.findings));
        std::exit(1);
    }
    const plan::Graph graph = plan::make_graph(checked);
    const run::RunOptions options;
    run::VirtualTime run(graph, library, options);
    const auto since = Clock::now();
    run.run();
    const std::chrono::nanoseconds took = Clock::now() - since;
    return static_cast<double>(took.count()) / static_cast<double>(count);
}

}  // namespace

int main() {
    run::CodeLibrary library;
    toolbox::add_core(library);
    run::Coded waits{.declared = {.name = "Waits", .outcomes = {{.name = "Done"}}}};
    waits.actor = [] { return std::make_unique<Waits>(); };
    library.add("bench", "", {waits});
    constexpr int64_t kActivations = int64_t{kActors} * kRounds;
    fmt::print(
        "figure: an actor that waits once, from its start to the next one's: {:.0f} ns ({})\n",
        run_of(rounds(), library, kActivations), kActivations);
    fmt::print(
        "figure: a wait of an actor that goes on: {:.0f} ns ({})\n",
        run_of(R"({"format":"vagus-plan/1","name":"One","toolboxes":["bench"],"start":{"actor":"a"},
                      "actors":{"a":{"template":"Waits","states":{"Done":"@terminate"}}}})",
               library, kWaits),
        kWaits);
}
