// What goes into the debugger of a running plan (run/debugger.hpp), and what comes out: values.
#pragma once

#include <cstdint>
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

}  // namespace vagus::run
