// What a Network has to tell: values, in the order in which things happened. Every request ends
// with exactly one RequestDone; all else comes unasked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "wire/reports.hpp"

namespace vagus::debug {

using NodeId = uint16_t;  // 1 … 0xfffe; 0 is a host

// One act that was asked of a node and that ends some time later.
struct RequestId {
    uint32_t value = 0;
    friend bool operator==(RequestId, RequestId) = default;
};

// What a node is doing, from its flags (wire spec, 3.2 and appendix A): STEP clear is running, STEP
// with ACTIVE is paused inside an event, STEP alone is stopped.
enum class ProgramState { Unknown, Running, Paused, Stopped };
// "unknown", "running", "paused", "stopped".
const char* name_of(ProgramState state);

// Where a node is: the source line is 0 if this host does not know the node's program.
struct CodePlace {
    uint16_t pc = 0;
    int line = 0;
    friend bool operator==(const CodePlace&, const CodePlace&) = default;
};

// ---- nodes ----
struct NodeAppeared {
    uint16_t protocol = 0;
};
// The description is complete: from now on the node can be worked with. Comes again if a node that
// was away comes back with another description.
struct NodeDescribed {
    std::string name;
};
// Asked kDescriptionTriesMax times in vain, or what came cannot be right.
struct DescriptionFailed {
    std::string why;
};
// Silent for kSilenceMax, or a `Disconnected` said that it left: then it is forgotten.
struct NodeDisconnected {
    bool forgotten = false;
};
struct NodeReconnected {};
// One that was away has described itself again, as it did before. One with another description
// tells NodeDescribed.
struct NodeConfirmed {};
struct ProtocolMismatch {
    uint16_t protocol = 0;
};
// Two nodes have this id: one of them needs another. `other_name` if they have two names.
struct NodeIdShared {
    std::string other_name;
};
// More nodes than kNodesMax: those after them are ignored. Told once.
struct TooManyNodes {};

// ---- programs ----
struct StateChanged {
    ProgramState state = ProgramState::Unknown;
    CodePlace at;
    // Paused because it came to a breakpoint, of any host (wire spec, 3.2); otherwise it was
    // told to pause, was reset, or an event waits for its stopped program.
    bool at_breakpoint = false;
    friend bool operator==(const StateChanged&, const StateChanged&) = default;
};
using wire::FaultKind;
// "array_access", "division_by_zero", "killed", "node_specific".
const char* name_of(FaultKind kind);
// What is said of a handler that runs for so long that it must have no end; nodes do not tell it.
inline constexpr const char* kEndlessText =
    "what it does at an event does not end; it may be in an endless loop";
struct Fault {
    FaultKind kind = FaultKind::NodeSpecific;
    CodePlace at;
    std::string text;  // one sentence without the place
};
// A breakpoint was set on the node, or refused (its table is full, its line has no code any more).
struct BreakpointResult {
    CodePlace at;
    bool success = false;
};
// The node has stopped at a breakpoint, whose condition is not evaluated yet: BreakpointHit,
// BreakpointPassed or ConditionFailed follows, unless the node is lost or told what to do before.
struct BreakpointReached {
    CodePlace at;
};
// The condition is false: the node goes on.
struct BreakpointPassed {
    CodePlace at;
};
// The node is paused at the line, which is not yet executed, and the condition is true.
struct BreakpointHit {
    CodePlace at;
    uint32_t hits = 0;  // this one included
};
// The condition could not be evaluated; the node stays paused.
struct ConditionFailed {
    CodePlace at;
    std::string why;
};
// Another host loaded something else into the node: lines and script variables are no longer known.
struct ProgramReplaced {};
// A node with `_program` told which program it runs: mark_of() it, 0 for none. Unasked after each
// description and each return.
struct ProgramTold {
    uint32_t mark = 0;
};

// Such a node was asked by itself, and nobody knows what it runs: it did not answer, or another
// host sent it words of a program meanwhile.
struct ProgramUntold {};

// ---- variables and events ----
// Answer to get(). `first` counts from the beginning of the variable.
struct VariablesArrived {
    RequestId request;
    std::string name;
    uint16_t first = 0;
    std::vector<int16_t> values;
};
// A watched variable differs from what was told last, or is told for the first time.
struct VariableChanged {
    std::string name;
    std::vector<int16_t> values;
};
struct UserEvent {
    uint16_t number = 0;
    std::string name;  // empty if the number is not among the common definitions
    std::vector<int16_t> arguments;
};

// ---- requests ----
struct RequestDone {
    RequestId request;
    std::optional<Error> error;  // none: it worked
    std::string note;            // what a person may want to know although it worked
};

using Happening =
    std::variant<NodeAppeared, NodeDescribed, DescriptionFailed, NodeDisconnected, NodeReconnected,
                 NodeConfirmed, ProtocolMismatch, NodeIdShared, TooManyNodes, StateChanged, Fault,
                 BreakpointResult, BreakpointReached, BreakpointPassed, BreakpointHit,
                 ConditionFailed, ProgramReplaced, ProgramTold, ProgramUntold, VariablesArrived,
                 VariableChanged, UserEvent, RequestDone>;

struct Event {
    Time at{};
    NodeId node = 0;  // for UserEvent the emitter: 0 is a host
    Happening what;
    uint32_t frame = 0;  // UserEvent: number of the frame that brought it, where frames have one
};

}  // namespace vagus::debug
