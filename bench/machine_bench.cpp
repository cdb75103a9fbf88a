// The decision machine alone, and how late supervisors are in real time.
//
//     build/release/bin/bench_machine     `figure:` lines: from an event to the next command, for
//                                         plans of 10 to 10,000 actors; lateness with a busy core
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/machine.hpp"
#include "plan/test_files.hpp"
#include "run/real_time.hpp"
#include "toolbox/core.hpp"

namespace {

using namespace vagus;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kEvents = 100'000;

// A ring: the event of each actor's supervisor leads to the next.
std::string ring(int actors) {
    std::string text = R"({"format":"vagus-plan/1","name":"Ring",
        "configuration":{"arg":{"type":"int","initial":0}},"start":{"actor":"a0"},"actors":{)";
    for (int i = 0; i < actors; ++i) {
        text += fmt::format(
            R"({}"a{}":{{"template":"Wait","in":{{"seconds":"1+arg"}},
            "states":{{"Done":"@terminate"}},
            "supervisors":{{"s{}":{{"template":"OnEvent","in":{{"event":"\"go\""}},
            "out":{{"arg0":"arg"}},"events":{{"Received":"a{}"}}}}}}}})",
            i == 0 ? "" : ",", i, i, (i + 1) % actors);
    }
    return text + "}}";
}

// Raised, stopped, begun: until the machine wants the next actor's code.
void measure_events(int actors, const run::CodeLibrary& library) {
    const plan::OneText file(ring(actors));
    const plan::Checked checked = plan::check("ring.plan.json", file, library.templates());
    const plan::Graph graph = plan::make_graph(checked);
    plan::Machine machine(graph);
    plan::Given given;
    given.outputs.resize(8);
    given.outputs[0] = plan::Value(int64_t{1});
    plan::WatchId watch = 0;
    plan::ActivationId active = 0;
    std::vector<int64_t> first, next;
    const auto obey = [&] {
        for (plan::Command& command : machine.take_commands()) {
            if (auto* start = std::get_if<plan::StartWatch>(&command)) watch = start->watch;
            if (auto* activate = std::get_if<plan::Activate>(&command)) {
                active = activate->activation;
            }
        }
    };
    machine.start({}, Time{0});
    obey();
    machine.begin(active, Time{0});
    obey();
    machine.take_trace();
    for (int i = 1; i <= kEvents; ++i) {
        machine.time_passed();
        const auto at = Clock::now();
        machine.raise(watch, given, Time{i});
        obey();
        const auto told = Clock::now();
        machine.stopped(active, Time{i});
        obey();
        machine.begin(active, Time{i});
        obey();
        const auto begun = Clock::now();
        machine.take_trace();
        first.push_back((told - at).count());
        next.push_back((begun - at).count());
    }
    const auto median = [](std::vector<int64_t>& all) {
        std::nth_element(all.begin(), all.begin() + kEvents / 2, all.end());
        return all[kEvents / 2];
    };
    fmt::print(
        "figure: {} actors: event to stop command {} ns, to the next actor's code {} ns "
        "(medians of {})\n",
        actors, median(first), median(next), kEvents);
}

void measure_lateness(const run::CodeLibrary& library) {
    const plan::OneText file(R"({"format":"vagus-plan/1","name":"Late",
        "configuration":{"x":{"type":"int","initial":0}},"start":{"actor":"rest"},
        "actors":{"rest":{"template":"WaitForever","states":{},"supervisors":{"w":{
        "template":"Watch","period_ms":1,"in":{"left":"x","op":"'=='","right":1},
        "events":{"True":"@terminate"}}}}}})");
    const plan::Checked checked = plan::check("late.plan.json", file, library.templates());
    const plan::Graph graph = plan::make_graph(checked);
    run::RunOptions options;
    options.max_time = 5s;
    std::atomic<bool> busy = true;
    std::thread burner([&busy] {
        while (busy) continue;
    });
    run::RealTime run(graph, library, options);
    run.run();
    busy = false;
    burner.join();
    const run::Lateness late = run.lateness();
    fmt::print(
        "figure: supervisor of period 1 ms, one core busy: lateness p50 {} us, p99 {} us, "
        "worst {} us, {} checks in 5 s\n",
        late.median.count(), late.p99.count(), late.worst.count(), late.checks);
}

}  // namespace

int main() {
    run::CodeLibrary library;
    toolbox::add_core(library);
    for (const int actors : {10, 100, 1'000, 10'000}) measure_events(actors, library);
    measure_lateness(library);
}
