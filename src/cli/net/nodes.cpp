// vagus net: list, describe, and the verbs that act on the program of one, several or all nodes.
#include <algorithm>
#include <map>

#include "aesl/node_file.hpp"
#include "cli/net/show.hpp"
#include "cli/net/verbs.hpp"
#include "cli/output.hpp"

namespace vagus::cli {

namespace {

constexpr size_t kFailuresOneByOne = 3;  // then nodes that did not answer are told together

// Which links they are on, only the switch knows.
void say_shared_id(const debug::NodeView& node) {
    if (!node.id_shared) return;
    const std::string names =
        node.other_name.empty() ? "" : ", \"" + node.name + "\" and \"" + node.other_name + "\"";
    complain("two nodes have the id " + std::to_string(node.id) + names +
             ": what is shown of them is mixed; give one of them another id (`vagus switch` names "
             "their links)");
}

}  // namespace

Failures complain_failed(const std::vector<Asked>& requests,
                         const std::vector<debug::Event>& events) {
    std::map<uint32_t, const debug::RequestDone*> ends;
    for (const debug::Event& event : events) {
        const auto* done = std::get_if<debug::RequestDone>(&event.what);
        if (done != nullptr) ends[done->request.value] = done;
    }
    Failures failures;
    std::vector<debug::NodeId> silent;
    std::vector<Error> said;
    for (const Asked& asked : requests) {
        const auto end = ends.find(asked.request.value);
        if (end == ends.end() || !end->second->error) continue;
        failures.code = kExitFailed;
        failures.nodes.insert(asked.node);
        if (end->second->error->code == Code::Timeout) silent.push_back(asked.node);
        said.push_back(*end->second->error);
    }
    silent.erase(std::unique(silent.begin(), silent.end()), silent.end());
    const bool together = silent.size() > kFailuresOneByOne;
    for (const Error& error : said) {
        if (!together || error.code != Code::Timeout) complain(error);
    }
    if (together) {
        complain(std::to_string(silent.size()) + " nodes did not answer: " + id_list(silent));
    }
    return failures;
}

Result<std::vector<debug::Event>> wait_all(NetSession& session, const std::vector<Asked>& asked) {
    std::vector<debug::RequestId> requests;
    for (const Asked& each : asked) requests.push_back(each.request);
    std::vector<debug::Event> events;
    (void)TRY(session.wait_done(requests, events));
    return events;
}

int complain_unreached(const NetSession& session, const std::vector<std::string>& named) {
    if (std::find(named.begin(), named.end(), "all") == named.end()) return kExitDone;
    const std::vector<debug::NodeId> ids = session.undescribed();
    if (ids.empty()) return kExitDone;
    return complain("not reached, since they do not say what they are: " + id_list(ids));
}

Verdict net_list(NetSession& session) {
    debug::RollCallOptions how;
    if (session.options().wait_s) how.quiet = how.first_within = session.wait_or(0);
    (void)TRY(session.discover(how));
    session.adopt_scripts();
    std::vector<debug::NodeId> ids = session.network().nodes();
    std::erase_if(ids, [&session](debug::NodeId id) { return !session.view(id).connected; });
    print(session.options().json ? show_nodes_json(session, ids) : show_nodes(session, ids));
    for (const debug::NodeId id : ids) say_shared_id(session.view(id));
    if (!ids.empty()) return kExitDone;
    return complain("no node answers on " + session.options().target);
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
    const bool halts = act == debug::Control::Kind::Pause || act == debug::Control::Kind::Reset;
    std::vector<debug::NodeId> ids =
        TRY(session.nodes(named, halts ? NetSession::Until::Everybody : NetSession::Until::Named));
    session.take_events();
    std::vector<Asked> asked;
    for (const debug::NodeId id : ids) {
        const auto sent = TRY(ask(session.network(), act, id));
        asked.push_back({id, sent});
    }
    const std::vector<debug::Event> events = TRY(wait_all(session, asked));
    if (halts) (void)TRY(brake_others(session, ids));
    say_notes(session, events);
    const int failed = complain_failed(asked, events).code;
    const int code = std::max(failed, complain_unreached(session, named));
    std::erase_if(ids,
                  [&session](debug::NodeId id) { return session.network().node(id) == nullptr; });
    print(session.options().json ? show_nodes_json(session, ids) : show_nodes(session, ids));
    return code;
}

}  // namespace vagus::cli
