// The program of one node: loads it, runs and stops it, steps by lines, keeps its breakpoints.
// Knows the node by its state messages, which do not say what they answer; so one request is under
// way at a time and the others wait, also for the turn of the node (debug/turns.hpp).
#pragma once

#include <deque>

#include "debug/condition.hpp"
#include "debug/outbox.hpp"

namespace vagus::debug {

// So often is a program sent to a node that tells another checksum than it should have.
constexpr int kLoadsMax = 3;
constexpr size_t kFragmentsAhead = 8;  // SetBytecode messages sent before the first answer

class Control {
public:
    enum class Kind { Load, Run, Pause, Stop, Reset, Step, Query, Save, Break };

    // `view` is the node's and lives longer than this; state, place, program and breakpoints are
    // written here.
    Control(NodeView& view, Outbox& out) : view_(view), out_(out) {}

    // ---- asked by the caller ----
    Result<RequestId> ask(Kind kind);
    // Before all that was asked, which is cancelled: Stop, Pause.
    RequestId at_once(Kind kind);
    Result<RequestId> load(SharedValue<aesl::Program> program, AfterLoad then);
    // What is being loaded, or waits for that, is not let run then. False: nothing is, or it was
    // told to run already; it counts as loaded.
    bool stay_after_load();
    void forget_program();
    void adopt(const aesl::Program& program);
    Result<RequestId> set_breakpoint(int line, std::string_view condition,
                                     const std::vector<aesl::Constant>& constants);
    Status clear_breakpoint(int line);
    void clear_breakpoints();
    // As another description of the same node left them: set when a program is known.
    void restore_breakpoints(const std::vector<LineBreakpoint>& breakpoints) {
        view_.breakpoints = breakpoints;
    }

    // ---- told by the node ----
    void receive(const wire::ExecutionStateChanged& state);
    void receive(const wire::BreakpointSetResult& result);
    void receive(const wire::Variables& variables);
    // All but NodeSpecificError stop the program without a further word (D20); Killed does not.
    void fault(FaultKind kind, uint16_t pc, const std::string& text);
    void node_specific(const std::string& text, uint16_t pc);
    // The node was described, or is back, and told which program it has (debug/program_mark.hpp).
    void returned_with(uint32_t mark);
    // Another host sent words of a program to this node.
    void foreign_bytecode(const wire::SetBytecode& words);
    // Another host stopped it.
    void foreign_stop();

    // ---- the condition of the breakpoint at which the node is paused ----
    // Its variables are wanted; nullptr if none are. Cleared by condition_read().
    const Condition* wanted_condition() const { return wanted_ ? &*wanted_ : nullptr; }
    // With the values of its variables(), or why they could not be read.
    void condition_read(const Result<std::vector<std::vector<int16_t>>>& values);
    // Counts the conditions asked for, so that values for an earlier stop are known as such.
    uint32_t condition_number() const { return condition_number_; }

    // ---- the connection ----
    // Described, or back after an absence: set the breakpoints again, ask for the state.
    void connected(const std::vector<aesl::Constant>& constants);
    void disconnected(const std::string& why);
    // It waited for its turn, which has come.
    void begin_turn();
    void tick();
    // When tick() has something to do; nothing if no request is under way.
    std::optional<Time> next_tick() const;

private:
    struct Request {
        RequestId id;
        Kind kind = Kind::Query;
        SharedValue<aesl::Program> program;  // Load
        AfterLoad then = AfterLoad::Run;     // Load
        size_t sent = 0, acked = 0;          // Load: fragments
        int loads = 1;                       // Load: so often sent as a whole
        bool asks_mark = false;              // Load: all is sent; is it what the node has?
        uint16_t pc = 0;                     // Break
        bool stepping = false;  // Step, Run: an instruction is being executed by itself
        int from_line = 0;      // Step
        uint32_t steps = 0;     // Step
        std::string note;       // Save: what the node said
        Time deadline{};
    };
    // Going on from a breakpoint whose condition is false: one step, then, if that was no fault,
    // Run.
    enum class Resume { No, Stepping, Running };
    struct Outcome {
        std::optional<Error> error;
        std::string note;
    };
    using Answer = std::optional<Outcome>;  // none: more is to come

    Result<RequestId> enqueue(Request request);
    void start_next();
    void give_up(const Error& why);
    void finish(Outcome outcome);
    Request* active(Kind kind);
    bool uploading();

    void restart_deadline(Request& request);
    void start(Request& request);
    void repeat(Request& request);
    void start_run(Request& request);
    void send_fragments(Request& request);
    void place_breakpoints();
    void place(LineBreakpoint& breakpoint);
    LineBreakpoint* breakpoint_at(uint16_t pc);

    Answer answer(Request& request, const wire::ExecutionStateChanged& state);
    Answer answer_load(Request& request, const wire::ExecutionStateChanged& state);
    void ask_mark();
    void after_mark(Request& load, std::optional<uint32_t> told);
    Answer loaded(Request& request);
    Answer load_again(Request& request, uint32_t told);
    Answer answer_run(Request& request, const wire::ExecutionStateChanged& state);
    Answer answer_step(Request& request, const wire::ExecutionStateChanged& state);
    Answer after_step(Request& request, const wire::ExecutionStateChanged& state);
    bool is_hit(ProgramState before, const wire::ExecutionStateChanged& state);
    void hit(LineBreakpoint& breakpoint);
    void step_and_ask();
    void lose_program();
    void note_restart(const wire::ExecutionStateChanged& state);
    void note_step(const wire::ExecutionStateChanged& state);
    void tell_state();
    CodePlace place_of(uint16_t pc) const;
    std::string who() const;

    NodeView& view_;
    Outbox& out_;
    std::deque<Request> requests_;  // the first is under way
    bool started_ = false;          // the first was sent
    Time ask_again_{};              // when it may have been lost
    uint16_t flags_ = 0;            // as told last
    bool left_by_step_ = false;  // stepped to where the node is paused: a breakpoint there was seen
    bool restart_check_ = false;  // the next state tells whether the node kept its program
    Resume resume_ = Resume::No;
    std::vector<aesl::Constant> constants_;  // for conditions
    std::optional<Condition> wanted_;
    uint32_t condition_number_ = 0;
    StateChanged told_;
};

// STEP clear: running; STEP and ACTIVE: paused; STEP alone: stopped.
ProgramState state_of(uint16_t flags);

}  // namespace vagus::debug
