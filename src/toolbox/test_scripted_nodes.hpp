// Nodes as tests need them: what the plan emits is kept with its time, and answered as the test
// says, after a time, through the bus of a run in virtual time.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "plan/trace.hpp"
#include "run/surroundings.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/core.hpp"

namespace vagus::toolbox {

class ScriptedNodes final : public run::Surroundings {
public:
    // Called for each event of the plan.
    using Answer = std::function<void(ScriptedNodes&, const run::BusEvent&)>;
    explicit ScriptedNodes(Answer answer) : answer_(std::move(answer)) {}

    void emit(Time, const run::BusEvent& event) override {
        said.push_back(
            fmt::format("{} {} {}", ms(now_), event.name, fmt::join(event.arguments, " ")));
        answer_(*this, event);
    }
    // The plan hears the event so much later, at least 1 ms.
    void send(Duration later, run::BusEvent event) {
        coming_.emplace(now_ + later, std::move(event));
    }

    // What the plan emitted: "MS NAME ARGUMENTS".
    std::vector<std::string> said;

    Time next() const override { return now_ + std::chrono::milliseconds(1); }
    std::vector<run::BusEvent> begin() override {
        now_ = next();
        std::vector<run::BusEvent> come;
        while (!coming_.empty() && coming_.begin()->first <= now_) {
            come.push_back(coming_.begin()->second);
            coming_.erase(coming_.begin());
        }
        return come;
    }
    void end() override {}

private:
    static int64_t ms(Time time) { return time / std::chrono::milliseconds(1); }

    Answer answer_;
    Time now_{0};
    std::multimap<Time, run::BusEvent> coming_;
};

struct Driven {
    run::Ended ended;
    std::vector<std::string> trace;  // "MS KIND …", what a plan that is driven by nodes shows
};

// Runs the plan in virtual time with those nodes; for at most a minute.
inline Driven drive(const std::string& plan_text, const run::CodeLibrary& library,
                    ScriptedNodes& nodes) {
    const plan::Checked checked =
        plan::check("test.plan.json", plan::OneText(plan_text), library.templates());
    if (!checked.ok()) {
        return {{plan::PlanResult::Error, plan::format_findings_json(checked.findings)}, {}};
    }
    const plan::Graph graph = plan::make_graph(checked);
    Driven driven;
    run::RunOptions options;
    options.max_time = std::chrono::minutes(1);
    options.surroundings = &nodes;
    options.on_trace = [&driven](const plan::TraceEvent& event) {
        driven.trace.push_back(plan::format_trace(event));
    };
    driven.ended = run::VirtualTime(graph, library, options).run();
    return driven;
}

}  // namespace vagus::toolbox
