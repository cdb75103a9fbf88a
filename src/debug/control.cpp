#include "debug/control.hpp"

#include <algorithm>

#include "debug/lines.hpp"
#include "debug/program_mark.hpp"

namespace vagus::debug {
namespace {

constexpr uint16_t kInitEvent = 0xffff;  // wire spec, 3.3
constexpr std::string_view kFlashing = "Flashing ";
constexpr std::string_view kFlashed =
    "Flashing OK";  // how a dsPIC says that WriteBytecode worked (2.3)

bool is_stepping_state(const wire::ExecutionStateChanged& state) {
    return (state.flags & wire::kFlagStep) != 0;
}

// What every SetBytecode and Reset leaves: STEP, ACTIVE with an init event, never RUNNING.
bool is_reset_state(const wire::ExecutionStateChanged& state) {
    return (state.flags & (wire::kFlagStep | wire::kFlagRunning)) == wire::kFlagStep;
}

// Its table of handlers, words [size, event, address, …], has the code before the first handler.
bool runs_at_start(const aesl::Program& program) {
    const std::vector<uint16_t>& words = program.bytecode;
    for (size_t i = 1; !words.empty() && i + 1 < words[0] && i < words.size(); i += 2) {
        if (words[i] == kInitEvent) return true;
    }
    return false;
}

// The answer to a Stop or to a question that was sent before SetBytecode does not count as its own:
// code before the first handler waits to run.
bool is_loaded_state(const wire::ExecutionStateChanged& state, const aesl::Program& program) {
    const bool waits = (state.flags & wire::kFlagActive) != 0;
    return is_reset_state(state) && (waits || !runs_at_start(program));
}

std::string hex_of(uint32_t checksum) {
    std::string text;
    for (int shift = 28; shift >= 0; shift -= 4)
        text += "0123456789abcdef"[(checksum >> shift) & 15];
    return text;
}

size_t fragments_of(const aesl::Program& program) {
    return (program.bytecode.size() + wire::kBytecodeWordsMax - 1) / wire::kBytecodeWordsMax;
}

const char* act_of(Control::Kind kind) {
    switch (kind) {
        case Control::Kind::Load:
            return "load the program";
        case Control::Kind::Run:
            return "run";
        case Control::Kind::Pause:
            return "pause";
        case Control::Kind::Stop:
            return "stop";
        case Control::Kind::Reset:
            return "reset";
        case Control::Kind::Step:
            return "step";
        case Control::Kind::Query:
            return "tell its state";
        case Control::Kind::Save:
            return "save its program";
        case Control::Kind::Break:
            return "set the breakpoint";
    }
    return "";
}

}  // namespace

ProgramState state_of(uint16_t flags) {
    if ((flags & wire::kFlagStep) == 0) return ProgramState::Running;
    return (flags & wire::kFlagActive) != 0 ? ProgramState::Paused : ProgramState::Stopped;
}

// ---- requests ----

Result<RequestId> Control::ask(Kind kind) {
    Request request;
    request.kind = kind;
    return enqueue(std::move(request));
}

// Not in its turn either: the frame leaves now, behind those that were sent before.
RequestId Control::at_once(Kind kind) {
    give_up({Code::Refused, who() + " was " + (kind == Kind::Stop ? "stopped" : "paused") +
                                " before that was done"});
    Request request;
    request.kind = kind;
    request.id = out_.new_request();
    requests_.push_back(std::move(request));
    begin_turn();
    return requests_.front().id;
}

void Control::give_up(const Error& why) {
    for (const Request& request : std::exchange(requests_, {})) {
        out_.tell(view_.id, RequestDone{request.id, why, ""});
    }
    started_ = false;
    out_.requests.leave(view_.id);
}

Result<RequestId> Control::load(SharedValue<aesl::Program> program, AfterLoad then) {
    const size_t words = program->bytecode.size();
    if (words == 0) {
        return Error{Code::BadInput, "the program for " + who() +
                                         " is empty: compile it, and fix its errors first"};
    }
    if (words > view_.target->bytecode_size) {
        return Error{Code::Limit, "the program has " + std::to_string(words) + " words, but " +
                                      who() + " has room for " +
                                      std::to_string(view_.target->bytecode_size) +
                                      ": shorten the script"};
    }
    Request request;
    request.kind = Kind::Load;
    request.program = std::move(program);
    request.then = then;
    return enqueue(std::move(request));
}

bool Control::stay_after_load() {
    if (active(Kind::Load) && !uploading()) finish({});
    bool stays = false;
    for (Request& request : requests_) {
        if (request.kind != Kind::Load) continue;
        request.then = AfterLoad::Stay;
        stays = true;
    }
    return stays;
}

Result<RequestId> Control::enqueue(Request request) {
    if (requests_.size() >= kRequestsMax) {
        return Error{Code::Limit, who() + " has " + std::to_string(kRequestsMax) +
                                      " requests waiting already: wait for its answers"};
    }
    request.id = out_.new_request();
    requests_.push_back(std::move(request));
    const RequestId id = requests_.back().id;
    start_next();
    return id;
}

// One after the other; a request that ends at once lets the next begin.
void Control::start_next() {
    if (started_ || requests_.empty()) return;
    if (out_.requests.enter(view_.id, out_.now)) begin_turn();
}

void Control::begin_turn() {
    if (started_ || requests_.empty()) return out_.requests.leave(view_.id);
    started_ = true;
    restart_deadline(requests_.front());
    start(requests_.front());
}

void Control::finish(Outcome outcome) {
    out_.tell(view_.id,
              RequestDone{requests_.front().id, std::move(outcome.error), std::move(outcome.note)});
    requests_.pop_front();
    started_ = false;
    out_.requests.leave(view_.id);
    start_next();
}

Control::Request* Control::active(Kind kind) {
    return started_ && requests_.front().kind == kind ? &requests_.front() : nullptr;
}

bool Control::uploading() {
    const Request* load = active(Kind::Load);
    return load != nullptr && load->acked < fragments_of(load->program);
}

void Control::start(Request& request) {
    // What the user asks for now overrules what a breakpoint's condition would decide.
    if (request.kind != Kind::Query && request.kind != Kind::Break) {
        wanted_.reset();
        resume_ = Resume::No;
    }
    if (request.kind == Kind::Load || request.kind == Kind::Reset) left_by_step_ = false;
    switch (request.kind) {
        case Kind::Load:
            return send_fragments(request);
        case Kind::Run:
            return start_run(request);
        case Kind::Pause:
            return out_.command<wire::Pause>(view_.id);
        case Kind::Stop:
            return out_.command<wire::Stop>(view_.id);
        case Kind::Reset:
            return out_.command<wire::Reset>(view_.id);
        case Kind::Step:
        case Kind::Query:
            return out_.command<wire::GetExecutionState>(view_.id);
        case Kind::Save:
            // The state behind it shows that the node has worked off the command: it need not
            // answer that itself.
            out_.command<wire::WriteBytecode>(view_.id);
            return out_.command<wire::GetExecutionState>(view_.id);
        case Kind::Break: {
            LineBreakpoint* breakpoint = breakpoint_at(request.pc);
            if (breakpoint != nullptr) return place(*breakpoint);
            return finish(
                {Error{Code::Refused, "the breakpoint was removed before it was set"}, ""});
        }
    }
}

// The node, or somebody on the way, may have had too much to do. Only what is the same twice is
// said twice: a step is not, nor is what the user would see happen again.
// The whole time for an answer counts from now.
void Control::restart_deadline(Request& request) {
    request.deadline = out_.now + kAnswerWithin;
    ask_again_ = out_.now + kAskAgain;
}

void Control::repeat(Request& request) {
    switch (request.kind) {
        case Kind::Load:
            if (request.asks_mark) return ask_mark();
            if (!uploading()) return out_.command<wire::Run>(view_.id);
            request.sent = request.acked = 0;  // the fragment that is missing may be any of them
            return send_fragments(request);
        case Kind::Run:
            if (!request.stepping) out_.command<wire::Run>(view_.id);
            return;
        case Kind::Pause:
        case Kind::Stop:
        case Kind::Query:
            return start(request);
        case Kind::Reset:
        case Kind::Step:
        case Kind::Save:
        case Kind::Break:
            return;
    }
}

// At a breakpoint `Run` would stop again at once: one instruction first (2.8). Not after a reset or
// an event that waits to start: a breakpoint on its first instruction has not been seen yet.
void Control::start_run(Request& request) {
    const bool at_breakpoint = (flags_ & wire::kFlagRunning) != 0 || left_by_step_;
    request.stepping = view_.state == ProgramState::Paused && at_breakpoint;
    if (request.stepping) return step_and_ask();
    out_.command<wire::Run>(view_.id);
}

// `Step` is answered only within an event, the question always.
void Control::step_and_ask() {
    out_.command<wire::Step>(view_.id);
    out_.command<wire::GetExecutionState>(view_.id);
}

void Control::send_fragments(Request& request) {
    const std::vector<uint16_t>& words = request.program->bytecode;
    while (request.sent < fragments_of(request.program) &&
           request.sent < request.acked + kFragmentsAhead) {
        const size_t start = request.sent++ * wire::kBytecodeWordsMax;
        auto fragment = message_to<wire::SetBytecode>(view_.id);
        fragment.start = static_cast<uint16_t>(start);
        fragment.words.count =
            static_cast<uint16_t>(std::min<size_t>(words.size() - start, wire::kBytecodeWordsMax));
        for (size_t i = 0; i < fragment.words.count; i++) {
            fragment.words.values[i] = static_cast<int16_t>(words[start + i]);
        }
        out_.send(fragment);
    }
}

// ---- answers ----

void Control::receive(const wire::ExecutionStateChanged& state) {
    const ProgramState before = view_.state;
    note_restart(state);
    note_step(state);
    flags_ = state.flags;
    view_.state = state_of(state.flags);
    view_.at = place_of(state.pc);
    view_.in_event = (state.flags & wire::kFlagActive) != 0;
    if (view_.state == ProgramState::Running) resume_ = Resume::No;
    if (resume_ == Resume::Stepping) {
        resume_ = Resume::Running;
        out_.command<wire::Run>(view_.id);
    }
    LineBreakpoint* breakpoint = is_hit(before, state) ? breakpoint_at(state.pc) : nullptr;
    Answer done;
    if (started_) done = answer(requests_.front(), state);
    const bool between = !done && (active(Kind::Load) || active(Kind::Step) || active(Kind::Run));
    if (breakpoint != nullptr) {
        hit(*breakpoint);
    } else if (!between && resume_ == Resume::No && !wanted_) {
        tell_state();
    }
    if (done) finish(std::move(*done));
}

void Control::lose_program() {
    forget_program();
    out_.tell(view_.id, ProgramReplaced{});
}

void Control::returned_with(uint32_t mark) {
    if (view_.program && mark != mark_of(view_.program->bytecode)) lose_program();
}

// A node that cannot tell its program, was away, and is paused as after power-up (3.1), although it
// had run, or would have run the code before the first handler: its program is gone.
void Control::note_restart(const wire::ExecutionStateChanged& state) {
    const bool fresh = state.pc == 0 && state.flags == 0;
    const bool lost = fresh && view_.program && (view_.at.pc != 0 || runs_at_start(*view_.program));
    if (std::exchange(restart_check_, false) && lost) lose_program();
}

// A breakpoint at which the node is paused because we stepped there counts as seen, until it moves.
void Control::note_step(const wire::ExecutionStateChanged& state) {
    const bool stepped = active(Kind::Step) && requests_.front().stepping;
    left_by_step_ = stepped || (left_by_step_ && state.pc == view_.at.pc &&
                                state_of(state.flags) == ProgramState::Paused);
}

Control::Answer Control::answer(Request& request, const wire::ExecutionStateChanged& state) {
    const bool steps = is_stepping_state(state);
    const bool idle = (state.flags & wire::kFlagActive) == 0;
    switch (request.kind) {
        case Kind::Load:
            return answer_load(request, state);
        case Kind::Run:
            return answer_run(request, state);
        case Kind::Pause:
            return steps ? Outcome{} : Answer{};
        case Kind::Stop:
            return steps && idle ? Outcome{} : Answer{};
        case Kind::Reset:
            return is_reset_state(state) ? Outcome{} : Answer{};
        case Kind::Step:
            return answer_step(request, state);
        case Kind::Query:
            return Outcome{};
        case Kind::Save:
            return Outcome{std::nullopt, request.note};
        case Kind::Break:
            return {};
    }
    return {};
}

Control::Answer Control::answer_load(Request& request, const wire::ExecutionStateChanged& state) {
    const size_t all = fragments_of(request.program);
    if (request.asks_mark) return {};
    if (request.acked == all) return is_stepping_state(state) ? Answer{} : Outcome{};
    if (!is_loaded_state(state, request.program)) return {};  // of what was said before
    request.acked++;
    restart_deadline(request);
    out_.requests.progress(view_.id, out_.now);
    send_fragments(request);
    if (request.acked < all) return {};
    if (!mark_address(view_.target)) return loaded(request);
    request.asks_mark = true;
    ask_mark();
    return {};
}

// Frames have no checksum: one that lost bytes is completed by the bytes behind it, and is answered
// like any other. A node that can tell what it has is asked before the program runs.
void Control::ask_mark() {
    auto ask = message_to<wire::GetVariables>(view_.id);
    ask.start = *mark_address(view_.target);
    ask.length = 2;
    out_.send(ask);
}

void Control::receive(const wire::Variables& variables) {
    Request* const load = active(Kind::Load);
    if (load == nullptr || !load->asks_mark || variables.values.count < 2 ||
        variables.start != mark_address(view_.target)) {
        return;
    }
    const auto word = [&variables](int i) {
        return uint32_t{static_cast<uint16_t>(variables.values.values[i])};
    };
    const uint32_t told = word(0) | word(1) << 16;
    after_mark(*load, told);
}

// Without a word from the node, which answers all but that, its program is believed: nobody waits
// for it for ever.
void Control::after_mark(Request& load, std::optional<uint32_t> told) {
    load.asks_mark = false;
    restart_deadline(load);
    const bool same = !told || *told == mark_of(load.program->bytecode);
    Answer done = same ? loaded(load) : load_again(load, *told);
    if (!done) return;
    tell_state();
    finish(std::move(*done));
}

Control::Answer Control::load_again(Request& request, uint32_t told) {
    if (request.loads == kLoadsMax) {
        forget_program();
        return Outcome{
            Error{Code::Unavailable,
                  who() + " does not have the program that was sent to it " +
                      std::to_string(kLoadsMax) + " times: expected the checksum " +
                      hex_of(mark_of(request.program->bytecode)) + ", it tells " + hex_of(told) +
                      ". Its line loses or changes bytes, or another host loads it, too; the "
                      "program was not run. Look at cable and baud rate, then load it again"},
            ""};
    }
    request.loads++;
    request.sent = request.acked = 0;
    out_.requests.progress(view_.id, out_.now);
    send_fragments(request);
    return {};
}

Control::Answer Control::loaded(Request& request) {
    view_.program = request.program;
    view_.at = place_of(view_.at.pc);
    place_breakpoints();
    if (request.then == AfterLoad::Stay) return Outcome{};
    out_.command<wire::Run>(view_.id);
    return {};
}

Control::Answer Control::answer_run(Request& request, const wire::ExecutionStateChanged& state) {
    if (!is_stepping_state(state)) return Outcome{};
    if (std::exchange(request.stepping, false)) out_.command<wire::Run>(view_.id);
    return {};
}

Control::Answer Control::answer_step(Request& request, const wire::ExecutionStateChanged& state) {
    request.deadline = out_.now + kAnswerWithin;
    if (request.stepping) return after_step(request, state);
    if (!is_stepping_state(state)) {
        return Outcome{Error{Code::Refused, who() + " is running: pause it before a step"}, ""};
    }
    if ((state.flags & wire::kFlagActive) == 0) {
        return Outcome{
            Error{Code::Refused, who() + " is paused, but not in an event: a step needs one; "
                                         "send it an event, or reset it"},
            ""};
    }
    request.stepping = true;
    request.from_line = place_of(state.pc).line;
    out_.command<wire::Step>(view_.id);
    return {};
}

// Until the line changes, an event begins or ends (language spec, 4.11).
Control::Answer Control::after_step(Request& request, const wire::ExecutionStateChanged& state) {
    request.steps++;
    if ((state.flags & wire::kFlagActive) == 0) return Outcome{std::nullopt, "the event has ended"};
    const bool known = view_.program.has_value();
    const bool moved = !known || place_of(state.pc).line != request.from_line ||
                       is_event_start(*view_.program, state.pc);
    if (moved || !is_stepping_state(state)) return Outcome{};
    if (request.steps >= kLineStepsMax) {
        return Outcome{
            Error{Code::Limit, who() + " is still on line " + std::to_string(request.from_line) +
                                   " after " + std::to_string(kLineStepsMax) +
                                   " instructions: it seems to loop there"},
            ""};
    }
    out_.command<wire::Step>(view_.id);
    return {};
}

void Control::fault(FaultKind kind, uint16_t pc, const std::string& text) {
    const CodePlace at = place_of(pc);
    out_.tell(view_.id, Fault{kind, at, text});
    if (kind == FaultKind::Killed) return;
    wanted_.reset();
    resume_ = Resume::No;
    flags_ = wire::kFlagStep;
    left_by_step_ = false;
    view_.state = ProgramState::Stopped;
    view_.at = at;
    if (!active(Kind::Load)) tell_state();
    const Request* run = active(Kind::Run);
    if (run == nullptr || !run->stepping) return;
    finish({Error{Code::Refused, who() + " stopped again at once: " + text}, ""});
}

// The report of WriteBytecode comes as an error message, whether it worked or not.
void Control::node_specific(const std::string& text, uint16_t pc) {
    Request* save = active(Kind::Save);
    if (!text.starts_with(kFlashing)) return fault(FaultKind::NodeSpecific, pc, text);
    if (save == nullptr) return;
    if (text == kFlashed) {
        save->note = "the node says: " + text;
        return;
    }
    finish({Error{Code::Refused, who() + " did not save its program: " + text}, ""});
}

void Control::foreign_bytecode(const wire::SetBytecode& words) {
    if (!view_.program || uploading()) return;
    const std::vector<uint16_t>& ours = view_.program->bytecode;
    bool same = words.start + size_t{words.words.count} <= ours.size();
    for (size_t i = 0; same && i < words.words.count; i++) {
        same = static_cast<uint16_t>(words.words.values[i]) == ours[words.start + i];
    }
    if (same) return;  // our own, come back from the switch
    lose_program();
}

// A switch drops the words that wait behind a Stop, and the answer to that Stop looks like the one
// to words of a program without code before the first handler: nobody knows what the node has now.
void Control::foreign_stop() {
    if (!active(Kind::Load)) return;
    finish({Error{Code::Refused, who() + " was stopped by another program while its script was "
                                         "loaded: load it again"},
            ""});
}

// ---- the connection ----

void Control::connected(const std::vector<aesl::Constant>& constants) {
    constants_ = constants;
    restart_check_ = !mark_address(view_.target);  // who can tell was asked
    if (view_.program) place_breakpoints();
    out_.command<wire::GetExecutionState>(view_.id);
}

void Control::disconnected(const std::string& why) {
    wanted_.reset();
    resume_ = Resume::No;
    for (LineBreakpoint& breakpoint : view_.breakpoints) breakpoint.on_node = false;
    give_up({Code::Unavailable, why});
}

void Control::tick() {
    if (!started_) return;
    if (out_.now < requests_.front().deadline) {
        if (out_.now < ask_again_) return;
        ask_again_ = out_.now + kAskAgain;
        return repeat(requests_.front());
    }
    if (requests_.front().asks_mark) return after_mark(requests_.front(), std::nullopt);
    finish({Error{Code::Timeout,
                  who() + " did not answer the request to " + act_of(requests_.front().kind) +
                      " within " + std::to_string(kAnswerWithin / std::chrono::seconds(1)) + " s"},
            ""});
}

std::optional<Time> Control::next_tick() const {
    if (!started_) return std::nullopt;
    return std::min(requests_.front().deadline, ask_again_);
}

void Control::tell_state() {
    const bool paused = view_.state == ProgramState::Paused;
    StateChanged now{view_.state, view_.at, paused && (flags_ & wire::kFlagRunning) != 0};
    // Wherever it runs it is the same state.
    if (now.state == ProgramState::Running && now.state == told_.state) now.at = told_.at;
    if (now == told_) return;
    told_ = now;
    out_.tell(view_.id, now);
}

CodePlace Control::place_of(uint16_t pc) const {
    return {pc, view_.program ? line_of(*view_.program, pc) : 0};
}

std::string Control::who() const {
    return "node " + std::to_string(view_.id) + " \"" + view_.name + "\"";
}

}  // namespace vagus::debug
