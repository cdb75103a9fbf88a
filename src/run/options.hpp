// What a run is started with and how it ends, in virtual and in real time alike.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "plan/trace.hpp"
#include "plan/value.hpp"
#include "run/code.hpp"

namespace vagus::run {

class CodeSource;
class Debugger;
class Surroundings;

// So long at most a supervisor's running check is waited for in real time (P18b).
constexpr Duration kCheckEndsWithin = std::chrono::milliseconds(100);

struct Raising;

struct RunOptions {
    uint64_t seed = 1;
    // Of the first running of code (see Numbers). On a bus that others command too it is to be a
    // random one: plans that all began at 1 would end each other's actors.
    uint16_t first_token = 1;
    Duration check_ends_within = kCheckEndsWithin;  // for tests
    // Then the run is aborted (plans.md, section 6).
    std::optional<Duration> max_time = {};
    std::vector<std::pair<int, plan::Value>> set = {};  // slots of the outermost plan
    // Called on the deciding thread between two decisions.
    std::function<void(const plan::TraceEvent&)> on_trace = {};
    // What the plan emits, for a bus beyond this run; called on the deciding thread.
    std::function<void(const BusEvent&)> on_emit = {};
    // In real time: what the run hears of the bus, as it is taken; called on the deciding thread.
    std::function<void(const BusEvent&, Time)> on_hear = {};
    // Whether the bus can carry it; the Error is the failure of the code that emits it. Called on
    // the thread of that code. What supervisors emit as they stop goes out in any case.
    std::function<Status(const BusEvent&)> may_emit = {};
    // How long the computer has slept so far. A run in real time that works on a bus ends when that
    // grows, as if it were stopped. Empty: by its clocks; a run that emits nothing does not ask.
    std::function<Duration()> slept = {};
    // In virtual time: what shares the run's clock (surroundings.hpp). Borrowed for the run.
    Surroundings* surroundings = nullptr;
    Debugger* debugger = nullptr;  // borrowed for the run
    // In virtual time: code in place of that of the toolboxes (code_source.hpp). Borrowed for the
    // run.
    CodeSource* code_source = nullptr;
    // In virtual time: whether an event is passed over, as if the check had found nothing. That is
    // how those are found that would have raised at the same instant.
    std::function<bool(const Raising&)> passes_over = {};
};

// What the check of a supervisor has found, before it is taken.
struct Raising {
    Time at{};
    const std::string& plan;  // instance path
    std::string_view supervisor;
    std::string_view event;
    bool ignored = false;  // by its target
    bool tied = false;     // more that it would end is due at this instant
};

// Throws CodeError with the sentence of may_emit.
void throw_if_refused(const RunOptions& options, const BusEvent& event);

struct Ended {
    plan::PlanResult result = plan::PlanResult::Ok;
    std::string message;     // of an error, or why the run was interrupted
    bool timed_out = false;  // max_time came, or nothing could ever fall due
};

// Exit status of a run (plans.md, section 6).
int exit_status(const Ended& ended);

}  // namespace vagus::run
