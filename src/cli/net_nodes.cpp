// vagus net: list, describe, and the verbs that act on the program of one, several or all nodes.
#include <algorithm>

#include "aesl/node_file.hpp"
#include "cli/net_show.hpp"
#include "cli/net_verbs.hpp"
#include "cli/output.hpp"

namespace vagus::cli {

Verdict net_list(NetSession& session) {
    const Duration quiet = session.wait_or(std::chrono::duration<double>(kQuiet).count());
    (void)TRY(session.discover(quiet));
    session.adopt_scripts();
    std::vector<debug::NodeId> ids = session.network().nodes();
    std::erase_if(ids, [&session](debug::NodeId id) { return !session.view(id).connected; });
    print(session.options().json ? show_nodes_json(session, ids) : show_nodes(session, ids));
    if (ids.empty() && !session.options().json) {  // "[]" says it, too
        complain("no node answers on " + session.options().target);
    }
    return kExitDone;
}

// For one node its file; for several a list of files, which is JSON too.
Verdict net_describe(NetSession& session, const std::vector<std::string>& named) {
    const std::vector<debug::NodeId> ids = TRY(session.nodes(named));
    std::string text;
    for (const debug::NodeId id : ids) {
        const debug::NodeView& node = session.view(id);
        if (session.options().json) {
            if (ids.size() > 1) text += text.empty() ? "[\n" : ",\n";
            text += aesl::format_node_file({node.target, session.network().common()});
        } else {
            text += (text.empty() ? "" : "\n") + show_description(node);
        }
    }
    if (session.options().json && ids.size() > 1) text += "]\n";
    print(text);
    return kExitDone;
}

namespace {

Result<debug::RequestId> ask(debug::Network& network, debug::Control::Kind act, debug::NodeId id) {
    switch (act) {
        case debug::Control::Kind::Run:
            return network.run(id);
        case debug::Control::Kind::Pause:
            return network.pause(id);
        case debug::Control::Kind::Stop:
            return network.stop(id);
        case debug::Control::Kind::Reset:
            return network.reset(id);
        case debug::Control::Kind::Step:
            return network.step(id);
        case debug::Control::Kind::Save:
            return network.save(id);
        case debug::Control::Kind::Query:
        case debug::Control::Kind::Load:
        case debug::Control::Kind::Break:
            return network.query(id);
    }
    return network.query(id);
}

// Faults that came meanwhile and notes of what worked: for people.
void say_notes(const NetSession& session, const std::vector<debug::Event>& events) {
    for (const debug::Event& event : events) {
        const std::string who = "node " + node_name(session, event.node);
        if (const auto* done = std::get_if<debug::RequestDone>(&event.what)) {
            if (!done->note.empty()) complain(who + ": " + done->note);
        }
        if (const auto* fault = std::get_if<debug::Fault>(&event.what)) {
            complain(who + ": " + fault->text + " at " +
                     show_place(session, event.node, fault->at));
        }
    }
}

}  // namespace

Verdict net_control(NetSession& session, debug::Control::Kind act,
                    const std::vector<std::string>& named) {
    std::vector<debug::NodeId> ids = TRY(session.nodes(named));
    session.take_events();
    std::vector<debug::RequestId> requests;
    for (const debug::NodeId id : ids) requests.push_back(TRY(ask(session.network(), act, id)));
    std::vector<debug::Event> events;
    (void)TRY(session.wait_done(requests, events));
    say_notes(session, events);
    int code = kExitDone;
    for (size_t i = 0; i < requests.size(); i++) {
        if (const auto error = error_of(events, requests[i])) code = complain(*error);
    }
    std::erase_if(ids,
                  [&session](debug::NodeId id) { return session.network().node(id) == nullptr; });
    print(session.options().json ? show_nodes_json(session, ids) : show_nodes(session, ids));
    return code;
}

}  // namespace vagus::cli
