// vagus net break: sets a breakpoint, waits until the node is paused there, says where. The
// condition is evaluated here, so a breakpoint lasts as long as the command, unless it is to be
// kept.
#include <algorithm>
#include <utility>

#include "cli/net/show.hpp"
#include "cli/net/verbs.hpp"
#include "cli/output.hpp"
#include "debug/lines.hpp"

namespace vagus::cli {
namespace {

// The script that is in the file for this node, told to the network.
Result<const aesl::Script*> script_in(NetSession& session, const std::string& file,
                                      debug::NodeId id) {
    session::ScriptFile scripts = TRY(read_scripts(file));
    if (scripts.plain) {
        const debug::NodeView& node = session.view(id);
        scripts.project.common = session::with_emitted(
            session.network().common(), scripts.project.scripts.front().source, node.target);
        scripts.project.scripts.front().node = node.name;
        scripts.project.scripts.front().node_id = id;
    }
    session.use_project(std::move(scripts));
    const aesl::Script* script = session.script_of(id);
    if (script != nullptr) return script;
    return Error{Code::NotFound, file + " has no script for node " + node_name(session, id)};
}

Result<int> script_line(const NetSession& session, const aesl::Script& script, debug::NodeId id,
                        const BreakOptions& options) {
    const aesl::Program& program = *session.view(id).program;
    const int line = options.line - script.first_line + 1;
    if (line > 0 && debug::pc_of(program, line) >= 0) return line;
    const int next = debug::next_line_with_code(program, std::max(line, 0));
    const std::string place = options.file + ":" + std::to_string(options.line);
    return Error{Code::NotFound, place + " has no code of node " + node_name(session, id) +
                                     (next > 0 ? "; the next line that has is " +
                                                     std::to_string(file_line(script, next))
                                               : "")};
}

// Every hit brakes the robot, even one whose condition turns out to be false: whether it is, is
// known only here, and until then there is no reflex.
Status brake_at_hit(NetSession& session, const debug::Event& event,
                    std::vector<debug::NodeId>& braked) {
    if (std::holds_alternative<debug::BreakpointReached>(event.what) ||
        std::holds_alternative<debug::Fault>(event.what)) {
        const auto paused = TRY(brake_others(session, {event.node}));
        braked.insert(braked.end(), paused.begin(), paused.end());
    } else if (std::holds_alternative<debug::BreakpointPassed>(event.what)) {
        for (const debug::NodeId id : std::exchange(braked, {})) {
            (void)session.network().run(id).ok();
        }
    }
    return Status::done();
}

// True at the first stop; false if the time is over or the user interrupts.
Result<bool> wait_for_hit(NetSession& session, debug::NodeId id) {
    const Time deadline =
        session.options().wait_s ? session.now() + session.wait_or(0) : Time::max();
    std::vector<debug::NodeId> braked;
    while (!session.interrupted() && session.now() < deadline) {
        for (const debug::Event& event : session.take_events()) {
            if (event.node == id) TRY(brake_at_hit(session, event, braked));
            const bool hit = std::holds_alternative<debug::BreakpointHit>(event.what);
            const bool failed = std::holds_alternative<debug::ConditionFailed>(event.what);
            const bool fault = std::holds_alternative<debug::Fault>(event.what);
            if (event.node != id || (!hit && !failed && !fault)) continue;
            print(session.options().json ? show_event_json(session, event)
                                         : show_event(session, event));
            if (!fault) return true;
        }
        (void)TRY(session.turn(deadline));
    }
    return false;
}

Result<bool> set_and_wait(NetSession& session, debug::NodeId id, int line,
                          const BreakOptions& options) {
    const debug::RequestId request =
        TRY(session.network().set_breakpoint(id, line, options.condition));
    std::vector<debug::Event> events;
    (void)TRY(session.wait_done({request}, events));
    if (const auto error = error_of(events, request)) return *error;
    const debug::NodeView& node = session.view(id);
    if (node.state != debug::ProgramState::Running) {
        complain("node " + node_name(session, id) + " is " + debug::name_of(node.state) +
                 ": it reaches no breakpoint until it runs");
    }
    return wait_for_hit(session, id);
}

}  // namespace

Verdict net_break(NetSession& session, const BreakOptions& options) {
    const debug::NodeId id = TRY(session.node(options.node, NetSession::Until::Everybody));
    if (options.clear) (void)TRY(session.network().clear_breakpoints(id));
    if (options.file.empty()) return kExitDone;
    const aesl::Script* script = TRY(script_in(session, options.file, id));
    const aesl::Options how = session::options_for(session.network().common(), {});
    const aesl::Compilation done = session.network().compile(id, script->source, how);
    if (!done.ok()) {
        return Error{Code::BadInput,
                     options.file + ":" +
                         std::to_string(file_line(*script, done.errors[0].at.line)) + ": " +
                         done.errors[0].message};
    }
    (void)TRY(session.network().adopt(id, done.program));
    const int line = TRY(script_line(session, *script, id, options));
    const Result<bool> hit = set_and_wait(session, id, line, options);
    if (!options.keep) (void)session.network().clear_breakpoint(id, line).ok();
    if (!hit.ok()) return hit.error();
    if (hit.value()) return kExitDone;
    return Error{Code::Timeout, "node " + node_name(session, id) + " did not reach " +
                                    options.file + ":" + std::to_string(options.line) + " in time"};
}

}  // namespace vagus::cli
