// The debugger of a running plan: breakpoints, pause, continue, step, reading and setting
// variables, raising events by hand. It is driven by values from any thread: requests go in,
// reports come out; the executor's deciding thread answers between two decisions, never in the
// middle of one.
//
//     Debugger debugger(graph, Debugger::At::Start);   // the run waits before its start
//     options.debugger = &debugger;                    // then VirtualTime or RealTime, on a thread
//     debugger.post(AddBreakpoint{{.element = "turn"}});
//     debugger.post(Continue{});
//     while (const auto report = debugger.wait_report(100ms)) …   // Answer, Stopped, RunOver
//
// A run in virtual time that was paused gives exactly the trace that it would have given, but for
// what was set or raised by hand. What a pause is in real time: docs/decisions/0090.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "plan/machine.hpp"
#include "run/debug_values.hpp"

namespace vagus::run {

constexpr size_t kDebugQueueMax = 10'000;  // requests that wait, reports that nobody took

class Debugger {
public:
    enum class At : uint8_t { Run, Start };
    // `graph` is borrowed. With At::Start each run waits before its start until it is let go.
    Debugger(const plan::Graph& graph, At first);
    ~Debugger();
    Debugger(const Debugger&) = delete;
    Debugger& operator=(const Debugger&) = delete;

    // ---- from any thread, before, during and between runs ----
    // The number that its Answer will have. Limit: too many wait.
    Result<uint64_t> post(Request request);
    // The next report, waiting so long for one. Of more than kDebugQueueMax the oldest are lost.
    std::optional<Report> wait_report(Duration at_most);
    // For who has but the deciding thread: called again and again while the run is paused and no
    // request waits, instead of blocking. It may post(). Set it before the run.
    void while_paused(std::function<void()> meanwhile);
    // For recording requests, and for repeating them in a rerun: called on the deciding thread. Set
    // it before the run.
    struct Follower {
        // Before a request may be taken, with the number of decisions so far. In virtual time a
        // number is the same point of every run. It may post().
        std::function<void(uint64_t place, Time)> comes = {};
        // Before a request is done.
        std::function<void(const Request&, Time)> asked = {};
    };
    void follow(Follower follower);

    // ---- for executors, on their deciding thread ----
    // A run begins. `wake` is called from any thread when a request has come. Borrowed: until
    // detach().
    void attach(plan::Machine& machine, EventGate& gate, std::function<void()> wake);
    // Answers one request, or pauses for what was met; blocks while paused. Between two decisions:
    // call it until it gives false, each time obeying the machine, and pause code and clock
    // still once paused().
    bool serve(Time now);
    bool paused() const;
    // An abort was asked for, perhaps before the start: then the run does not start.
    bool aborted() const;
    void see(const plan::TraceEvent& event);
    // The plan is handed an event of the bus.
    void heard();
    // As TakeVersion that only asks, at once.
    std::vector<std::string> reasons_against(const plan::NewVersion& next) const;
    // Begin is due for the innermost activation: must the run pause first? Then look again at
    // what is due when it goes on.
    bool stops_before_begin();
    // The instant at which a pause is wanted; tell when the run's clock has reached it.
    std::optional<Time> instant() const;
    void reach_instant(Time now);
    void detach(const RunOver& over);

private:
    class Core;
    std::unique_ptr<Core> core_;
};

}  // namespace vagus::run
