// What happened in a run, as values and as the lines of docs/plans.md, section 6.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/time.hpp"
#include "plan/value.hpp"

namespace vagus::plan {

struct Graph;

// How a plan ended.
enum class PlanResult : uint8_t { Ok, Interrupted, Error };
std::string_view name_of(PlanResult result);

// Names point into the Graph of the run, or into that of the change before them.
struct PlanStarted {};
struct PlanEnded {
    PlanResult result;
    std::string message;  // of an error
};
struct ActorStarted {
    std::string_view actor;
    uint64_t activation;
    std::vector<std::pair<std::string_view, Value>> in;
};
struct ActorEnded {
    std::string_view actor;
    uint64_t activation;
    std::string_view state;
    std::string_view target;
};
struct EventRaised {
    std::string_view supervisor;
    std::string_view event;
    std::string_view target;
    bool global;
    uint64_t activation;
};
struct ActorInterrupted {
    std::string_view actor;
    uint64_t activation;
    bool ran;
    Duration stop;
};
struct VariableWritten {
    std::string_view variable;
    Value value;
    std::string_view by;
};
struct CheckLate {
    std::string_view supervisor;
    Duration by;
};
struct TextLogged {
    std::string_view actor;
    std::string text;
};
struct ErrorFound {
    std::string_view element;
    std::string message;
};
// A new version of this plan was accepted (P31). Owners of the graph: the run, and what follows
// the trace.
struct PlanChanged {
    std::shared_ptr<const Graph> graph;
};

struct TraceEvent {
    Time at{};
    std::string plan;  // instance path: "WallFollow/calibrate"
    std::variant<PlanStarted, PlanEnded, ActorStarted, ActorEnded, EventRaised, ActorInterrupted,
                 VariableWritten, CheckLate, TextLogged, ErrorFound, PlanChanged>
        what;
    uint32_t frame = 0;  // number of the frame of a bus that it follows from, where frames have one
};

constexpr std::string_view kTraceBegins = "{\"t\":";

// One line of JSON, without the newline. With a robot, where there are several with plans, the line
// names it.
std::string format_trace(const TraceEvent& event, std::string_view robot = {});

}  // namespace vagus::plan
