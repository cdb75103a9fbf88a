// What the nodes tell: for the log of happenings, for the people, for what comes back by itself.
#include <fmt/format.h>

#include <algorithm>

#include "serve/target/target.hpp"

#include "serve/json.hpp"

namespace vagus::serve {

void Target::happen(Happened happened) {
    happened.t = time();
    happened.wall = desk_.wall_ms();
    told_.happened(happened);
    Json happening = happening_json(happened);
    happening["run"] = told_.run();
    desk_.topics().add("happenings", happening);
}

void Target::hear(const debug::Event& event, const debug::NodeDescribed&) {
    scripts_.targets_changed();
    desk_.topics().touch("scripts");
    desk_.topics().touch("script");
    desk_.topics().touch("findings");
    desk_.topics().touch("node");
    if (!stopping_.state_of(event.node)) quiet_ = false;
    Known& known = known_[event.node];
    const auto loaded = hints_.loaded_already(event.node);
    if (loaded && !known.has_program) {
        known.loaded = *loaded;
        known.has_program = true;
        return restore(event.node);
    }
    came_back(event.node);
}

void Target::hear(const debug::Event& event, const debug::StateChanged& state) {
    Known& known = known_[event.node];
    note_state(event.node, state.state);
    // It was let run from elsewhere.
    const bool runs = state.state == debug::ProgramState::Running;
    if (runs && stopping_.state_of(event.node) == StopNode::State::Stopped) quiet_ = false;
    note_held(event.node, state);
    known.busy_looks = 0;
    known.endless = false;
    if (state.state == debug::ProgramState::Running) {
        known.why.clear();
        known.stopped = false;
        known.fault.clear();
    } else if (known.why.empty()) {
        known.why = "asked";
    }
    dropped_.state(event.node, state.state);
}

// Another program on the bus may have paused it, too. What is loaded was told to stand.
void Target::note_state(uint16_t node, debug::ProgramState state) {
    Known& known = known_[node];
    const bool ran = std::exchange(known.runs, state == debug::ProgramState::Running);
    const bool told = known.stopped || known.braking || known.busy == "loading";
    if (ran && !known.runs && !told) brake(node);
}

void Target::hear(const debug::Event& event, const debug::Fault& fault) {
    Known& known = known_[event.node];
    if (fault.kind != debug::FaultKind::Killed) brake(event.node);
    known.fault = fault.text;
    known.fault_line = fault.at.line;
    known.why = "fault";
    known.held = false;
    // Killed: somebody wanted it, and the others run on.
    if (fault.kind != debug::FaultKind::Killed) hints_.stopped_at_breakpoint();
    const std::string place = fault.at.line > 0 ? fmt::format(" at line {}", fault.at.line) : "";
    say_("error", fmt::format("{}{}: {}", name_of(event.node), place, fault.text));
}

void Target::hear(const debug::Event& event, const debug::BreakpointHit& hit) {
    ScriptBreakpoint* breakpoint = breakpoint_of(event.node, hit.at.line);
    if (breakpoint) breakpoint->hits = hit.hits;
    desk_.topics().touch("breakpoints");
    if (breakpoint && hit.hits <= breakpoint->ignore) {
        note_move();
        (void)network_->run(event.node).ok();
        return release(event.node);
    }
    known_[event.node].why = "breakpoint";
    hints_.stopped_at_breakpoint();
    if (breakpoint && breakpoint->once && breakpoints_.clear_once()) place_breakpoints();
    say_("note", fmt::format("{} is paused at line {}", name_of(event.node), hit.at.line));
}

void Target::hear_place(const debug::Event& event, const debug::BreakpointResult& result) {
    ScriptBreakpoint* breakpoint = breakpoint_of(event.node, result.at.line);
    desk_.topics().touch("breakpoints");
    if (!breakpoint) return;
    breakpoint->set = result.success;
    breakpoint->why = result.success ? "" : "the node refused it: its table of breakpoints is full";
}

void Target::hear(const debug::Event& event, const debug::UserEvent& sent) {
    ++events_;
    const std::string name = shown_name(sent);
    if (traffic_.size() < kTrafficMax || traffic_.contains({event.node, name})) {
        ++traffic_[{event.node, name}];
    }
    if (event.node != wire::kHostId) tells_.event(name, sent.arguments);
    count_dropped(event.node, sent.number);
}

// All paused nodes discard the event; the one that emitted it does not hear it.
void Target::count_dropped(uint16_t from, uint16_t event) {
    for (const uint16_t id : live_nodes()) {
        if (id == from || !dropped_.is_paused(id)) continue;
        const auto& program = network_->node(id)->program;
        dropped_.came(id, program ? std::optional(handles(*program, event)) : std::nullopt);
        desk_.topics().touch("robot");
    }
}

void Target::hear(const debug::Event& event) {
    desk_.topics().touch("robot");
    told_.event(event);
    if (auto happened = happened_of(event, source_of(event.node))) happen(std::move(*happened));
    // A node that was just being started may have said meanwhile that it runs.
    if (const auto stopped = stopping_.hear(event)) known_[*stopped].stopped = true;
    (void)resting_.hear(event);
    const auto* what = &event.what;
    if (const auto* done = std::get_if<debug::RequestDone>(what)) {
        if (known_[event.node].braking == done->request) known_[event.node].braking.reset();
        if (known_[event.node].look == done->request) note_look(event.node, !done->error);
        hear(*done);
    } else if (const auto* described = std::get_if<debug::NodeDescribed>(what)) {
        hear(event, *described);
    } else if (const auto* state = std::get_if<debug::StateChanged>(what)) {
        hear(event, *state);
    } else if (const auto* fault = std::get_if<debug::Fault>(what)) {
        hear(event, *fault);
    } else if (const auto* hit = std::get_if<debug::BreakpointHit>(what)) {
        hear(event, *hit);
    } else if (std::get_if<debug::BreakpointReached>(what)) {
        brake(event.node);
    } else if (std::get_if<debug::BreakpointPassed>(what)) {
        release(event.node);
    } else if (const auto* placed = std::get_if<debug::BreakpointResult>(what)) {
        hear_place(event, *placed);
    } else if (const auto* sent = std::get_if<debug::UserEvent>(what)) {
        hear(event, *sent);
    } else if (const auto* changed = std::get_if<debug::VariableChanged>(what)) {
        hear(event, *changed);
    } else if (const auto* condition = std::get_if<debug::ConditionFailed>(what)) {
        say_("warning", fmt::format("{}: the condition at line {} cannot be evaluated: {}",
                                    name_of(event.node), condition->at.line, condition->why));
        hints_.stopped_at_breakpoint();
    } else if (std::get_if<debug::ProgramReplaced>(what)) {
        Known& known = known_[event.node];
        known.lost_program = known.lost_program || known.has_program;
        known.has_program = false;
    } else if (std::holds_alternative<debug::NodeDisconnected>(*what)) {
        dropped_.state(event.node, debug::ProgramState::Unknown);
        went_away(event.node);
    } else if (std::holds_alternative<debug::NodeReconnected>(*what)) {
        quiet_ = false;  // it may have been switched on again, and run what it keeps
        place_breakpoints();
    } else if (const auto* told = std::get_if<debug::ProgramTold>(what)) {
        told_program(event.node, told->mark);
    } else if (std::get_if<debug::ProgramUntold>(what)) {
        if (known_[event.node].in_doubt) program_is_lost(event.node);
    } else if (std::get_if<debug::NodeConfirmed>(what)) {
        came_back(event.node);
    }
}

}  // namespace vagus::serve
