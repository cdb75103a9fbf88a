// The decision logic of a running plan (docs/plans.md, section 4): one pure state machine. It is
// told what happened - begun, ended, raised, stopped, failed, abort - and answers with what is to
// be done: start and stop supervisors, start and stop the code of one actor. No threads, no clock,
// no input or output; executors (module run) put those around it.
//
//     Machine machine(graph);
//     machine.start({}, Time{0});
//     for (;;) {
//         for (Command& command : machine.take_commands()) obey(command);
//         for (TraceEvent& event : machine.take_trace()) write(event);
//         if (machine.over()) break;
//         …  // wait for what comes next; tell the machine
//     }
//
// What ends an activation is taken one at a time; of several, the first told wins, and what comes
// too late is recognised by its number and has no effect (P20). So executors may tell late things
// safely; they must tell them in the order of P21 or of arrival.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "plan/change.hpp"
#include "plan/graph.hpp"
#include "plan/trace.hpp"

namespace vagus::plan {

constexpr int kPlanDepthMax = 64;                      // P2; the outermost plan is 1
constexpr uint64_t kActivationsAtOnceMax = 1'000'000;  // P30

// One watching of a supervisor, from its start to its stop. Never used twice in a run.
using WatchId = uint64_t;
// Numbers of activations are in the trace too.
using ActivationId = uint64_t;

// What the code of a template gave: a state or event, and its outputs. An output that was not set
// is not written (P17a).
struct Given {
    int outcome = 0;
    std::vector<std::optional<Value>> outputs;  // by the template's declaration
};

// ---- what the machine wants done ----
struct StartWatch {
    WatchId watch;
    int level;  // 0: the outermost plan
    bool global;
    int index;  // file order among its kind at this level
    const GraphSupervisor* supervisor;
};
struct StopWatch {
    WatchId watch;
};
// The activation is there; begin() is due for it when all that ranks before has been taken (P16a).
struct Activate {
    ActivationId activation;
    int level;
};
struct StartCode {
    ActivationId activation;
    int level;
    const GraphActor* actor;
    std::vector<Value> in;
};
struct StopCode {
    ActivationId activation;  // answer with stopped(), or overstayed() when its grace time is over
};
// The sub-plan of this activation has ended: end_sub_plan() is due at this instant (P21a).
struct SubPlanOver {
    ActivationId activation;
    int level;  // of the actor
};
// After a change (P31): where each global supervisor is in its file may be another; place_of()
// tells.
struct RankAgain {};
using Command =
    std::variant<StartWatch, StopWatch, Activate, StartCode, StopCode, SubPlanOver, RankAgain>;

// How far the activation of a level is.
enum class Phase : uint8_t {
    Pending,   // begin() is due
    Running,   // its code, or a plan inside it, runs
    SubEnded,  // the plan inside it has ended: end_sub_plan() is due
    Stopping,  // its code has been told to stop
    None,      // no activation: the plan is ending
};

// One supervisor of the plan at `level`, of its start tag or of the actor that is active there.
struct WatchPlace {
    int level = 0;
    bool global = false;
    int index = 0;  // file order among its kind
};

class Machine {
public:
    // The graph is borrowed for the life of the machine.
    explicit Machine(const Graph& graph);
    ~Machine();
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    // Starts the run with values set from outside, in their order, converted already (P15).
    void start(const std::vector<std::pair<int, Value>>& outside, Time now);

    // ---- what happened ----
    // The activation's turn has come: reads its inputs, starts its code or its sub-plan.
    void begin(ActivationId activation, Time now);
    void end(ActivationId activation, const Given& given, Time now);
    void end_sub_plan(ActivationId activation, Time now);
    void raise(WatchId watch, const Given& given, Time now);
    // Code threw. `cause` is a sentence without names; the machine adds plan and element.
    void fail(ActivationId activation, std::string_view cause, Time now);
    void fail_watch(WatchId watch, std::string_view cause, Time now);
    // Answers to StopCode.
    void stopped(ActivationId activation, Time now);
    void overstayed(ActivationId activation, Time now);
    void abort(Time now);
    // The run cannot go on for a reason outside of it: like an abort, but with the result Error. A
    // run that is being aborted stays so.
    void fail_run(std::string_view cause, Time now);
    // A line for the log, from the code of the activation.
    void log(ActivationId activation, std::string text, Time now);
    void late(WatchId watch, Duration by, Time now);
    // Time has passed since the last activation (P30).
    void time_passed();

    // ---- hot change (P31) ----
    // A sentence for each thing that is in the way of the new version now; empty: none.
    std::vector<std::string> reasons_against(const NewVersion& next) const;
    // The new version takes over if nothing is in its way; what does is given back.
    std::vector<std::string> change(const NewVersion& next, Time now);

    // ---- values ----
    // The supervisor's inputs as one snapshot; on an Error tell it to fail_watch().
    Result<std::vector<Value>> read_inputs(WatchId watch) const;
    // Of the outermost plan, by slot. Writing converts; its trace is a `write` by `outside` (P29).
    const Value& variable(int slot) const;
    Status write_outside(int slot, const Value& value, Time now);
    // Of any level of the plan that runs now.
    const Value& variable(int level, int slot) const;
    Status write_outside(int level, int slot, const Value& value, Time now);

    // ---- what is going on ----
    bool over() const;
    PlanResult result() const;
    const std::string& message() const;  // of an error
    bool watching(WatchId watch) const;
    int depth() const;                          // number of plans that run inside one another
    const GraphPlan& plan_at(int level) const;  // its newest version
    const std::string& path_at(int level) const;
    const GraphActor* actor_at(int level) const;  // as it was started
    ActivationId activation_at(int level) const;
    Phase phase_at(int level) const;
    // 0: it does not watch now.
    WatchId watch_at(const WatchPlace& place) const;
    // Of one that watches.
    WatchPlace place_of(WatchId watch) const;
    // Supervisors at this level and below are not checked while code is being stopped (P18a);
    // nothing is being stopped: -1.
    int stopping_level() const;

    std::vector<Command> take_commands();
    std::vector<TraceEvent> take_trace();

private:
    struct Level;
    struct After;
    struct Watch;
    struct Version;

    // starting
    void push_level(const GraphPlan& plan, std::string path);
    void start_globals(int level, Time now);
    void activate(int level, int actor, Time now);
    void begin_sub_plan(int level, std::vector<Value> in, Time now);
    void restart_globals(int level);
    void start_watch(int level, bool global, int index);
    void stop_watch(Watch& watch);
    void stop_own(int level);
    void stop_globals(int level);
    // ending
    void interrupt(int level, After after, Time now);
    void finish_stop(Time now);
    void follow(int level, int target, PlanResult at_terminate, Time now);
    void end_plan(int level, PlanResult result, std::string message, Time now);
    void fail_plan(int level, std::string_view element, std::string_view cause, Time now);
    // values
    static Result<std::vector<Value>> read(const Version& version,
                                           const std::vector<GraphInput>& inputs);
    struct Writer;
    Status write_outputs(int level, const Writer& writer,
                         const std::vector<std::optional<Value>>& values, Time now);
    Status feed(int level, const GraphActor& caller, const std::vector<Value>& in, Time now);
    std::vector<std::optional<Value>> outputs_of(int level) const;
    Value& cell(int level, int slot) const;
    std::string_view target_name(int level, int target) const;
    std::string sentence(int level, std::string_view element, std::string_view cause) const;
    // hot change
    Underway underway(int level) const;
    std::shared_ptr<Version> make_version(int level, const GraphPlan& plan,
                                          const Version* before) const;
    const GraphPlan* plan_in(const Graph& graph, int level) const;
    void take_version(int level, const GraphPlan& plan);
    void take_globals(int level, const GraphPlan& plan);
    void tell_change(int level, const Version& before, Time now);
    // finding
    Level& at(int level) const;
    int level_of(ActivationId activation) const;
    Watch* find(WatchId watch) const;
    void trace(int level, Time now, decltype(TraceEvent::what) what);

    const Graph* graph_;  // the newest; those before it are named in the trace, and kept
    std::vector<std::shared_ptr<const Graph>> changes_;
    std::vector<std::unique_ptr<Level>> levels_;
    ActivationId activations_ = 0;
    uint64_t at_once_ = 0;
    WatchId watches_ = 0;
    int stopping_from_ = -1;
    bool over_ = false;
    PlanResult result_ = PlanResult::Ok;
    std::string message_;
    std::vector<Command> commands_;
    std::vector<TraceEvent> trace_;
};

}  // namespace vagus::plan
