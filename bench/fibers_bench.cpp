// Plans of many short actors in virtual time: what it costs to let one go on, and to come back.
//
//     build/release/bin/bench_fibers      `figure:` lines: an activation, a wait, and of these the
//                                         two switches alone
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
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
constexpr int64_t kActivations = 200'000;
constexpr int64_t kWaits = 1'000'000;

double ns_each(Clock::time_point since, int64_t count) {
    return static_cast<double>((Clock::now() - since).count()) / static_cast<double>(count);
}

// A ring of actors that each wait a millisecond.
std::string ring() {
    std::string text = R"({"format":"vagus-plan/1","name":"Short","start":{"actor":"a0"},
        "actors":{)";
    for (int i = 0; i < kActors; ++i) {
        text += fmt::format(
            R"({}"a{}":{{"template":"Wait","in":{{"seconds":"0.001"}},"states":{{"Done":"a{}"}}}})",
            i == 0 ? "" : ",", i, (i + 1) % kActors);
    }
    return text + "}}";
}

class Waits final : public run::Actor {
    void run(run::ActorContext& context) override {
        for (int64_t i = 0; i < kWaits; ++i) context.sleep(1ms);
        context.end(0);
    }
};

double run_of(const std::string& text, const run::CodeLibrary& library, run::Duration time,
              int64_t count) {
    const plan::OneText file(text);
    const plan::Checked checked = plan::check("short.plan.json", file, library.templates());
    const plan::Graph graph = plan::make_graph(checked);
    run::RunOptions options;
    options.max_time = time;
    run::VirtualTime run(graph, library, options);
    const auto since = Clock::now();
    run.run();
    return ns_each(since, count);
}

}  // namespace

int main() {
    run::CodeLibrary library;
    toolbox::add_core(library);
    run::Coded waits{.declared = {.name = "Waits", .outcomes = {{.name = "Done"}}}};
    waits.actor = [] { return std::make_unique<Waits>(); };
    library.add("bench", "", {waits});
    fmt::print("figure: an actor that waits once, from its beginning to the next: {:.0f} ns ({})\n",
               run_of(ring(), library, kActivations * 1ms, kActivations), kActivations);
    const std::string one = R"({"format":"vagus-plan/1","name":"One","start":{"actor":"a"},
        "actors":{"a":{"template":"Waits","states":{"Done":"@terminate"}}}})";
    fmt::print("figure: a wait of an actor that goes on: {:.0f} ns ({})\n",
               run_of(one, library, 2 * kWaits * 1ms, kWaits), kWaits);
}
