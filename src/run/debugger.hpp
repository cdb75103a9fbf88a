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
#include <utility>
#include <variant>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "plan/machine.hpp"
#include "run/breakpoints.hpp"
#include "run/held_events.hpp"

namespace vagus::run {

constexpr size_t kDebugQueueMax = 10'000;  // requests that wait, reports that nobody took
// So long at most a plan runs with one event alone, by its own clock: meanwhile it is deaf.
constexpr Duration kEventStep = std::chrono::milliseconds(100);

// ---- requests ----
struct AddBreakpoint {  // answer: its number
    Breakpoint breakpoint;
};
struct RemoveBreakpoint {
    int id;
};
struct EnableBreakpoint {
    int id;
    bool enabled;
};
struct ListBreakpoints {};
// At once, or when the run's clock reaches an instant, before all that is due then.
struct Pause {
    std::optional<Time> at = {};
};
struct Continue {
    // false: only from a pause that was asked for, not from one at a breakpoint or after a step.
    bool from_met = true;
};
// On to the next actor that is about to begin, at any level.
struct Step {};
// The run ends as by an abort from outside (P28).
struct Abort {};
struct AskWhere {};  // answer: Where
// An Expression over the variables of the plan at `level`. Answer: its value.
struct Evaluate {
    int level = 0;
    std::string expression;
};
// While paused: a write by `outside` (P29), also of an inner plan.
struct SetVariable {
    int level = 0;
    std::string name;
    plan::Value value;
};
// While paused: as if the supervisor, which must watch now, had raised the event.
struct RaiseEvent {
    std::string supervisor;
    std::string event;
    std::vector<std::pair<std::string, plan::Value>> outputs = {};
};
// A new version of plans that run (P31), while they run or are paused. Answer: a Change.
struct TakeVersion {
    plan::NewVersion next;
    bool only_ask = false;  // what is in its way now; nothing changes
};
// ---- events of the bus that came while it is paused; they go to the plan when it continues ----
struct ListHeld {};  // answer: HeldNow
// While paused: to the plan before all others, which takes it up when it goes on.
struct LetGo {
    std::optional<uint64_t> number = {};  // without: all, in their order
};
struct DropHeld {
    std::optional<uint64_t> number = {};  // without: all
};
// While paused: lets that one go and runs to the next thing that the plan does, for kEventStep at
// most. All others, and what comes meanwhile, stay held.
struct StepEvent {
    std::optional<uint64_t> number = {};  // without: the first
};
using Request = std::variant<AddBreakpoint, RemoveBreakpoint, EnableBreakpoint, ListBreakpoints,
                             Pause, Continue, Step, Abort, AskWhere, Evaluate, SetVariable,
                             RaiseEvent, TakeVersion, ListHeld, LetGo, DropHeld, StepEvent>;

// ---- reports ----
struct VariableNow {
    std::string name;
    plan::Type type;
    plan::Value value;
};
struct SupervisorNow {
    std::string name;
    bool global;
    bool watching;
    std::vector<std::string> events;
};
// One plan that runs, with the actor that is active in it.
struct LevelNow {
    std::string path;
    std::string actor;
    plan::ActivationId activation;
    plan::Phase phase;
    std::vector<VariableNow> variables;
    std::vector<SupervisorNow> supervisors;
};
struct Where {
    Time at{};
    bool paused = false;
    std::vector<LevelNow> levels = {};  // none: before the start
};
struct Change {
    std::vector<std::string> reasons = {};  // against it, a sentence each; none: accepted
};
using Reply = std::variant<Done, int, std::vector<Breakpoint>, plan::Value, Where, Change, HeldNow>;

struct Answer {
    uint64_t request;  // as post() numbered it
    Result<Reply> reply;
};
struct Stopped {
    enum class Why : uint8_t { Start, Asked, Instant, Step, Breakpoint };
    Why why = Why::Asked;
    std::vector<int> breakpoints = {};
    Where where = {};
};
struct RunOver {
    Time at{};
    plan::PlanResult result = plan::PlanResult::Ok;
    std::string message = {};  // of an error
};
using Report = std::variant<Answer, Stopped, RunOver>;

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
