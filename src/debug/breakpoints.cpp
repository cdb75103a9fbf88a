// Control's breakpoints: where they are on the node, what happens when it stops at one.
#include <algorithm>

#include "debug/control.hpp"
#include "debug/lines.hpp"

namespace vagus::debug {

Result<RequestId> Control::set_breakpoint(int line, std::string_view condition,
                                          const std::vector<aesl::Constant>& constants) {
    if (!view_.program) {
        return Error{Code::NotFound, "the program of " + who() +
                                         " is not known here, so neither are its lines: load it, "
                                         "or give its project"};
    }
    const int pc = pc_of(*view_.program, line);
    if (pc < 0) {
        const int next = next_line_with_code(*view_.program, line);
        return Error{Code::NotFound,
                     "line " + std::to_string(line) +
                         " has no code, so it cannot take a breakpoint" +
                         (next > 0 ? "; the next line with code is " + std::to_string(next) : "")};
    }
    if (!condition.empty()) {
        (void)TRY(Condition::parse(condition, view_.program->variables, constants));
    }
    constants_ = constants;
    const auto same = [line](const LineBreakpoint& breakpoint) { return breakpoint.line == line; };
    auto& all = view_.breakpoints;
    const bool fresh = std::none_of(all.begin(), all.end(), same);
    if (fresh && all.size() >= kBreakpointsMax) {
        return Error{Code::Limit, who() + " has " + std::to_string(kBreakpointsMax) +
                                      " breakpoints already: remove one first"};
    }
    Request request;
    request.kind = Kind::Break;
    request.pc = static_cast<uint16_t>(pc);
    if (fresh) all.push_back({.line = line, .condition = {}, .pc = request.pc});
    std::find_if(all.begin(), all.end(), same)->condition = condition;
    return enqueue(std::move(request));
}

Status Control::clear_breakpoint(int line) {
    auto& all = view_.breakpoints;
    const auto found =
        std::find_if(all.begin(), all.end(),
                     [line](const LineBreakpoint& breakpoint) { return breakpoint.line == line; });
    if (found == all.end()) {
        return Error{Code::NotFound, who() + " has no breakpoint on line " + std::to_string(line)};
    }
    auto clear = message_to<wire::BreakpointClear>(view_.id);
    clear.pc = found->pc;
    if (found->on_node) out_.send(clear);
    all.erase(found);
    return Status::done();
}

void Control::clear_breakpoints() {
    view_.breakpoints.clear();
    out_.command<wire::BreakpointClearAll>(view_.id);
}

// After a load or an absence: the table of the node is made again. A line that has lost its code
// keeps its breakpoint here, not on the node.
void Control::place_breakpoints() {
    out_.command<wire::BreakpointClearAll>(view_.id);
    for (LineBreakpoint& breakpoint : view_.breakpoints) {
        breakpoint.on_node = false;
        const int pc = pc_of(*view_.program, breakpoint.line);
        if (pc < 0) {
            out_.tell(view_.id, BreakpointResult{{0, breakpoint.line}, false});
            continue;
        }
        breakpoint.pc = static_cast<uint16_t>(pc);
        place(breakpoint);
    }
}

// Cleared first: nodes put the same counter into their table twice (D17).
void Control::place(LineBreakpoint& breakpoint) {
    auto clear = message_to<wire::BreakpointClear>(view_.id);
    auto set = message_to<wire::BreakpointSet>(view_.id);
    clear.pc = set.pc = breakpoint.pc;
    out_.send(clear);
    out_.send(set);
}

void Control::adopt(const aesl::Program& program) {
    view_.program = program;
    view_.at = place_of(view_.at.pc);
    if (!view_.breakpoints.empty()) place_breakpoints();
}

void Control::forget_program() {
    view_.program.reset();
    view_.at.line = 0;
    wanted_.reset();
    for (LineBreakpoint& breakpoint : view_.breakpoints) breakpoint.on_node = false;
}

LineBreakpoint* Control::breakpoint_at(uint16_t pc) {
    for (LineBreakpoint& breakpoint : view_.breakpoints) {
        if (breakpoint.pc == pc && view_.program) return &breakpoint;
    }
    return nullptr;
}

void Control::receive(const wire::BreakpointSetResult& result) {
    LineBreakpoint* breakpoint = breakpoint_at(result.pc);
    if (breakpoint != nullptr) breakpoint->on_node = result.success != 0;
    out_.tell(view_.id, BreakpointResult{place_of(result.pc), result.success != 0});
    const Request* request = active(Kind::Break);
    if (request == nullptr || request->pc != result.pc) return;
    if (result.success != 0) return finish({});
    std::erase_if(view_.breakpoints,
                  [&result](const LineBreakpoint& b) { return b.pc == result.pc; });
    finish({Error{Code::Refused, who() + " refused the breakpoint: its table is full; remove those "
                                         "of other programs first"},
            ""});
}

// The node was running, now it is before an instruction with a breakpoint, and nobody asked it
// to pause.
bool Control::is_hit(ProgramState before, const wire::ExecutionStateChanged& state) {
    const bool asked =
        active(Kind::Pause) || active(Kind::Reset) || active(Kind::Query) || uploading();
    return before == ProgramState::Running && view_.state == ProgramState::Paused && !asked &&
           breakpoint_at(state.pc) != nullptr;
}

void Control::hit(LineBreakpoint& breakpoint) {
    out_.tell(view_.id, BreakpointReached{view_.at});
    if (breakpoint.condition.empty()) {
        breakpoint.hits++;
        tell_state();
        return out_.tell(view_.id, BreakpointHit{view_.at, breakpoint.hits});
    }
    Result<Condition> condition =
        Condition::parse(breakpoint.condition, view_.program->variables, constants_);
    condition_number_++;
    if (condition.ok()) {
        wanted_ = std::move(condition.value());
        if (wanted_->variables().empty()) condition_read(std::vector<std::vector<int16_t>>{});
        return;
    }
    tell_state();  // a variable of the condition went with an older program
    out_.tell(view_.id, ConditionFailed{view_.at, condition.error().what});
}

void Control::condition_read(const Result<std::vector<std::vector<int16_t>>>& values) {
    if (!wanted_) return;
    const Condition condition = std::move(*wanted_);
    wanted_.reset();
    const Result<bool> holds =
        values.ok() ? condition.evaluate(values.value()) : Result<bool>(values.error());
    if (holds.ok() && !holds.value()) {
        resume_ = Resume::Stepping;
        out_.tell(view_.id, BreakpointPassed{view_.at});
        return step_and_ask();
    }
    tell_state();
    if (!holds.ok()) return out_.tell(view_.id, ConditionFailed{view_.at, holds.error().what});
    LineBreakpoint* breakpoint = breakpoint_at(view_.at.pc);
    if (breakpoint == nullptr) return;
    breakpoint->hits++;
    out_.tell(view_.id, BreakpointHit{view_.at, breakpoint->hits});
}

}  // namespace vagus::debug
