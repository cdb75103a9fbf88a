// Runs plans from a program of your own: the door for the runtime integrator.
//
//     PlanRun run(plan, {.clock = Clock::Real});         // LoadedPlan: loaded_plan.hpp
//     run.listen([](const plan::TraceEvent& event) { puts(plan::format_trace(event).c_str()); });
//     run.write("speed", plan::Value(12.5));             // before the start: as `--set` does
//     const run::Ended ended = run.run();                // blocks until the plan has ended
//
// From other threads, while it runs: read(), write(), abort(), hear(). In virtual time the run is
// one chain of steps without a pause: there these are for listeners and for actors' code.
//
// A plan as a function, which a plan that calls a sub-plan does too:
//
//     const auto called = call(plan, {{"n", plan::Value(3.0)}}, {.clock = Clock::Virtual});
//     if (called.ok()) show(called.value().ended.result, called.value().outputs.at("sum"));
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "embed/loaded_plan.hpp"
#include "plan/trace.hpp"
#include "run/execution.hpp"
#include "run/options.hpp"

namespace vagus::embed {

using run::Clock;

struct RunSettings {
    Clock clock = Clock::Real;
    uint64_t seed = 1;
    std::optional<Duration> max_time = {};  // then the run is aborted
};

class PlanRun {
public:
    // `plan` is ok(). One object is one run.
    explicit PlanRun(const LoadedPlan& plan, const RunSettings& settings = {});
    ~PlanRun();

    // Before run(). Each line of the trace as it happens, on the thread of run(); and what the plan
    // emits on the bus.
    void listen(std::function<void(const plan::TraceEvent&)> listener);
    void listen_to_bus(std::function<void(const run::BusEvent&)> listener);

    run::Ended run();

    // A variable of the outermost plan. Before run(): its value at the start; later the value that
    // the plan wrote last. The Error says that there is none of that name.
    Result<plan::Value> read(std::string_view variable) const;
    // Converts (P11); the Error says what does not fit. Seen from the next reading of inputs on.
    Status write(std::string_view variable, const plan::Value& value);
    // Ends the run with the result Interrupted (P28). Without effect before run().
    void abort();
    // An event has come from the bus; for runs in real time.
    Status hear(run::BusEvent event);

private:
    class Run;
    std::unique_ptr<Run> run_;
};

struct Called {
    run::Ended ended;
    std::map<std::string, plan::Value> outputs;  // variables with access `out` and `inout`; those
        // of a plan that ended with Error count for nothing
};

// Runs the plan with those inputs (access `in` and `inout`). The Error names an input that does not
// exist, does not fit, or lacks a value.
Result<Called> call(const LoadedPlan& plan, const std::map<std::string, plan::Value>& inputs,
                    const RunSettings& settings = {});

}  // namespace vagus::embed
