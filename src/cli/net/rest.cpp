// vagus net: stop, and what `set` does with a variable that drives: both end with nodes at rest,
// read back.
#include <algorithm>

#include "base/text.hpp"
#include "cli/net/show.hpp"
#include "cli/net/verbs.hpp"
#include "cli/output.hpp"
#include "session/brake.hpp"
#include "session/stopping.hpp"

namespace vagus::cli {

namespace {

using session::StopNode;
using session::Stopping;
using State = session::StopNode::State;

constexpr double kRestWithin_s = 5;  // for nodes to be read back; --wait: another time

Result<session::SafeStop> safe_stop_for(const NetSession& session) {
    const std::string& project = session.options().project_file;
    if (project.empty()) return session::shipped_safe_stop();
    return session::safe_stop_around(project, {});
}

// Goes on after Ctrl-C, for that is what ends direct driving. Fails only if the connection does.
Result<std::vector<StopNode>> bring_to_rest(NetSession& session, const session::SafeStop& safe,
                                            Stopping::How how,
                                            const std::vector<debug::NodeId>& nodes,
                                            Duration within) {
    session.take_events();
    Stopping stopping;
    stopping.begin(session.network(), safe, Stopping::Manner{.how = how}, session.now(), nodes);
    const Time latest = session.now() + within;
    while (!stopping.settled() && session.now() < latest) {
        (void)TRY(session.turn(std::min(latest, stopping.next_tick())));
        for (const debug::Event& event : session.take_events()) stopping.hear(event);
        stopping.tick(session.now());
    }
    return stopping.report();
}

// An exit code.
int complain_moving(const std::vector<StopNode>& nodes) {
    int code = kExitDone;
    for (const StopNode& node : nodes) {
        const std::string who = "node " + std::to_string(node.node) +
                                (node.name.empty() ? "" : " \"" + node.name + "\"");
        switch (node.state) {
            case State::Stopped:
                break;
            case State::Moving:
                code = complain(who + " still moves: what was read back is not at rest");
                break;
            case State::Asked:
            case State::Silent:
                code = complain(who + " did not answer: nobody knows whether it is at rest");
                break;
            case State::Gone:
                code = complain(who + " has left: nobody knows whether it is at rest");
                break;
        }
    }
    return code;
}

Duration rest_within() {
    return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(kRestWithin_s));
}

}  // namespace

Result<std::vector<debug::NodeId>> brake_others(NetSession& session,
                                                const std::vector<debug::NodeId>& causes) {
    const session::SafeStop safe = TRY(safe_stop_for(session));
    debug::Network& network = session.network();
    for (const debug::NodeId id : causes) session::make_safe(network, safe, id);
    const auto others = session::others_that_move(network, safe, {causes.begin(), causes.end()});
    std::vector<Asked> asked;
    std::vector<std::string> names;
    for (const debug::NodeId id : others) {
        if (const auto request = network.pause_now(id)) asked.push_back({id, *request});
        session::make_safe(network, safe, id);
        names.push_back(session::name_with_id(network, id));
    }
    if (asked.empty()) return others;
    std::vector<debug::Event> events = TRY(wait_all(session, asked));
    (void)complain_failed(asked, events);
    session.put_back(std::move(events));
    say("a robot moves only while all its nodes run: paused too, and made safe: " +
        list_of({names.begin(), names.end()}) + "; `run all` lets them run again\n");
    return others;
}

Verdict net_stop(NetSession& session, const std::vector<std::string>& named) {
    const session::SafeStop safe = TRY(safe_stop_for(session));
    Result<std::vector<debug::NodeId>> found = session.nodes(named);
    const bool all = std::find(named.begin(), named.end(), "all") != named.end();
    // Those that do not say what they are hear Stop all the same.
    std::vector<debug::NodeId> ids = all ? session.undescribed() : std::vector<debug::NodeId>();
    if (!found.ok() && ids.empty()) return found.error();
    if (found.ok()) ids.insert(ids.end(), found.value().begin(), found.value().end());
    std::sort(ids.begin(), ids.end());
    const auto nodes =
        TRY(bring_to_rest(session, safe, Stopping::How::Stop, ids, session.wait_or(kRestWithin_s)));
    const int code = std::max(complain_moving(nodes), complain_unreached(session, named));
    // Those that were named do not wait for the others to be found.
    if (!all) {
        (void)TRY(session.nodes(named, NetSession::Until::Everybody));
        (void)TRY(brake_others(session, ids));
    }
    std::erase_if(ids,
                  [&session](debug::NodeId id) { return session.network().node(id) == nullptr; });
    print(session.options().json ? show_nodes_json(session, ids) : show_nodes(session, ids));
    return code;
}

Result<bool> is_driving(const NetSession& session, debug::NodeId id,
                        const debug::VariableRange& range, const std::vector<int16_t>& values) {
    const session::SafeStop safe = TRY(safe_stop_for(session));
    const auto node = safe.find(session.view(id).name);
    if (node == safe.end()) return false;
    for (const auto& [name, rest] : node->second.set) {
        if (name != range.name) continue;
        for (size_t i = 0; i < values.size(); i++) {
            const size_t at = range.first + i;
            if (at < rest.size() && values[i] != rest[at]) return true;
        }
    }
    return false;
}

Verdict drive_until_end(NetSession& session, debug::NodeId id) {
    const session::SafeStop safe = TRY(safe_stop_for(session));
    const std::string who = "node " + node_name(session, id);
    const Time end = session.options().wait_s ? session.now() + session.wait_or(0) : Time::max();
    say(who + " is driven by hand as long as this command runs: Ctrl-C stops it (--leave: " +
        "set it and return)\n");
    while (!session.interrupted() && session.now() < end) {
        session.take_events();
        (void)TRY(session.turn(end));
    }
    const auto nodes = TRY(bring_to_rest(session, safe, Stopping::How::Rest, {id}, rest_within()));
    say(session::describe(nodes) + "\n");
    return complain_moving(nodes);
}

}  // namespace vagus::cli
