// What the life of a run is told, and what it wants done (life.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "serve/target/stop_report.hpp"

namespace vagus::serve::life {

// Of a command that waits for its answer; 0: nobody waits.
using CallNumber = uint64_t;

// Why a run ends.
enum class Why { Stop, Plan, Error, Died, Signal, Target, Project, Version, Alone, Slept, Before };
// Those that are told.
constexpr Why kWhys[] = {Why::Stop,   Why::Plan,    Why::Error,   Why::Died,  Why::Signal,
                         Why::Target, Why::Project, Why::Version, Why::Alone, Why::Slept};
// "stop", "plan", "error", … as the protocol has them. `Before`, which is told to nobody, stops a
// robot that is about to be driven and is not known to be at rest.
const char* name_of(Why why);

struct Cause {
    std::string by;  // a page's name, a signal, "plan", "server"
    Why why = Why::Stop;
};

// One end, as it is told: once.
struct End {
    uint64_t number = 0;
    Cause cause;
    std::string result;  // of the plan: OK, Interrupted, Error; empty: there was none
    std::string message;
    std::vector<StopNode> nodes;
};

// ---- what it is told ----

// A bus was connected: its nodes are whatever they are.
struct Joined {};
// The world as its file says, without a plan; its time passes at once or not.
struct Open {
    CallNumber call = 0;
    bool go = false;
    std::string by = {};
    bool past = false;  // it continues from an instant of a run before
};
// Run: what is paused continues, or everything begins.
struct Start {
    CallNumber call = 0;
    bool plan = false;         // there is one to run
    bool world_again = false;  // the world does not stand there, or is another by now
    bool go = true;            // otherwise the plan is paused before its first actor
    bool again = false;        // also if it runs
    bool past = false;         // it continues from an instant of a run before
    std::string by = {};
    // Nothing has happened since the last Stop that can move a node of a bus.
    bool quiet = true;
};
// The process of the run has opened what it was told to open, or cannot.
struct Opened {};
struct Failed {
    std::string why;
};
// All nodes of the world have said what they are.
struct Described {};
// The nodes of that start have their scripts; they run.
struct Loaded {
    uint64_t start = 0;
};
struct Went {
    uint64_t start = 0;
};
// A node came to a breakpoint.
struct Halted {};
struct Pause {
    CallNumber call = 0;
};
struct NodesPaused {
    CallNumber call = 0;
    std::string why;  // not; empty: they are
};
// The plan alone is held, goes on, or is to end; the nodes stay as they are.
struct HoldPlan {
    CallNumber call = 0;
};
struct ContinuePlan {
    CallNumber call = 0;
};
struct EndThePlan {
    CallNumber call = 0;
    std::string by;
};
// The plan goes on as soon as the nodes have breakpoints for a step into a script.
struct StepInto {
    CallNumber call = 0;
};
struct BreakpointsSet {};
struct PlanEnded {
    std::string result = {}, message = {};
};
struct Died {
    std::string why;
};
struct Stop {
    CallNumber call = 0;
    Cause cause;
};
// What became of the nodes that were stopped or made safe; again whenever that changes.
struct Stopped {
    uint64_t number = 0;
    StopReport report;
};
// Another target, project or version: `drives` says that something was sent that can move a node.
struct Leave {
    CallNumber call = 0;
    Cause cause;
    bool drives = false;
};

using Input = std::variant<Joined, Open, Start, Opened, Failed, Described, Loaded, Went, Halted,
                           Pause, NodesPaused, HoldPlan, ContinuePlan, EndThePlan, StepInto,
                           BreakpointsSet, PlanEnded, Died, Stop, Stopped, Leave>;

// ---- what is to be done ----

// The process of the run is to open the world alone, again with its robots where they are, or
// the plan (in its world, or on the bus).
struct OpenRunner {
    enum class What { World, WorldAgain, Plan };
    What what = What::World;
    CallNumber call = 0;  // whose plan
};
// The nodes of the world that was opened can be talked to.
struct ConnectWorld {};
// On a bus: scripts are to run, and no plan.
struct BeginScripts {};
// Loaded{start} follows.
struct LoadNodes {
    uint64_t start = 0;
    bool fresh = false;  // the world has just been opened: they get their breakpoints, too
};
// All of them, or those that are paused. Went{start} follows.
struct LetNodesGo {
    uint64_t start = 0;
    bool all = false;
};
struct BeginRun {};     // of a world that was opened
struct ContinueRun {};  // its clock, or the plan on a bus
struct StepPlan {};     // to its first actor
struct PauseRun {};
struct RestRun {};
// NodesPaused{call} follows.
struct PauseNodes {
    CallNumber call = 0;
};
struct CountStart {};  // a run has begun
// The plan is told to end; with `silence`, the bus gets no more of it than that work ends.
struct EndPlan {
    bool silence = true;
};
// Stopped{number} follows.
struct StopNodes {
    uint64_t number = 0;
};
// What makes nodes safe is written while their scripts run. Of a bus, Stopped{number} follows.
struct MakeSafe {
    uint64_t number = 0;
};
// The process of the run does not open what it was told to open: it is killed.
struct EndRunner {
    std::string why;  // the end of "the run …"
};
// The process of the run ends, and nobody is talked to any more.
struct Disconnect {};
// Leaving is possible now: what waits behind `call` is done.
struct GoOnLeaving {
    CallNumber call = 0;
};
struct Answer {
    CallNumber call = 0;
    std::string code, why;  // empty: done
};
struct AnswerStop {
    CallNumber call = 0;
    StopReport report;
};
struct Tell {
    End end;
    bool again = false;  // only its nodes are others than when it was told first
};

using Action =
    std::variant<OpenRunner, ConnectWorld, LoadNodes, LetNodesGo, BeginRun, ContinueRun, StepPlan,
                 PauseRun, RestRun, PauseNodes, CountStart, EndPlan, StopNodes, MakeSafe,
                 Disconnect, GoOnLeaving, Answer, AnswerStop, Tell, EndRunner, BeginScripts>;
using Actions = std::vector<Action>;

}  // namespace vagus::serve::life
