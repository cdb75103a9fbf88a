// vagus net: get, set, emit, watch, log.
#include <algorithm>
#include <map>

#include "base/json.hpp"
#include "cli/net/show.hpp"
#include "cli/net/verbs.hpp"
#include "cli/output.hpp"
#include "debug/names.hpp"

namespace vagus::cli {
namespace {

struct Wanted {
    std::string typed;
    debug::VariableRange range;
};

// All variables of the node if none is named.
Result<std::vector<Wanted>> wanted_of(NetSession& session, debug::NodeId id,
                                      std::vector<std::string> typed) {
    if (typed.empty()) {
        for (const auto& place : debug::variables_of(session.view(id))) {
            if (place.size > 0) typed.push_back(place.name);
        }
    }
    std::vector<Wanted> wanted;
    for (const std::string& name : typed) {
        const auto variable = TRY(session.network().variable(id, name));
        wanted.push_back({name, variable});
    }
    return wanted;
}

std::string show_values(const std::vector<std::pair<std::string, std::vector<int16_t>>>& values,
                        bool json) {
    if (!json) {
        std::vector<std::string> names;
        for (const auto& [name, words] : values) names.push_back(name);
        std::string lines;
        for (const auto& [name, words] : values) {
            lines += padded(name, widest(names)) + " = " + spaced(words) + "\n";
        }
        return lines;
    }
    std::string text = "{";
    for (const auto& [name, words] : values) {
        text += (text.size() > 1 ? ",\n  " : "\n  ") + json_quote(name) + ": " + json_words(words);
    }
    return text + (values.empty() ? "}\n" : "\n}\n");
}

}  // namespace

// So many requests at a time that the node's limit is kept (debug::kRequestsMax).
Verdict net_get(NetSession& session, const std::string& node,
                const std::vector<std::string>& variables) {
    const debug::NodeId id = TRY(session.node(node));
    const std::vector<Wanted> wanted = TRY(wanted_of(session, id, variables));
    std::vector<std::pair<std::string, std::vector<int16_t>>> values;
    for (size_t first = 0; first < wanted.size(); first += debug::kRequestsMax) {
        const size_t end = std::min(wanted.size(), first + debug::kRequestsMax);
        std::vector<debug::RequestId> requests;
        for (size_t i = first; i < end; i++) {
            requests.push_back(TRY(session.network().get(id, wanted[i].range)));
        }
        std::vector<debug::Event> events;
        (void)TRY(session.wait_done(requests, events));
        std::map<uint32_t, std::vector<int16_t>> arrived;
        for (const debug::Event& event : events) {
            const auto* words = std::get_if<debug::VariablesArrived>(&event.what);
            if (words != nullptr) arrived[words->request.value] = words->values;
        }
        for (size_t i = first; i < end; i++) {
            const debug::RequestId request = requests[i - first];
            if (const auto error = error_of(events, request)) return *error;
            values.emplace_back(wanted[i].typed, arrived[request.value]);
        }
    }
    print(show_values(values, session.options().json));
    return kExitDone;
}

Verdict net_set(NetSession& session, const std::string& node, const std::string& variable,
                const std::vector<int16_t>& values, bool leave) {
    const debug::NodeId id = TRY(session.node(node));
    const debug::VariableRange range = TRY(session.network().variable(id, variable));
    const debug::RequestId request = TRY(session.network().set(id, range, values));
    std::vector<debug::Event> events;
    (void)TRY(session.wait_done({request}, events));
    if (const auto error = error_of(events, request)) return *error;
    print(show_values({{variable, values}}, session.options().json));
    const bool drives = !leave && TRY(is_driving(session, id, range, values));
    return drives ? drive_until_end(session, id) : Verdict(kExitDone);
}

Verdict net_emit(NetSession& session, const std::string& event,
                 const std::vector<int16_t>& arguments) {
    (void)TRY(session.network().emit(event, arguments));
    return kExitDone;
}

namespace {

// Prints what `shown` lets through until the time is up, the user interrupts, or nobody reads any
// more.
template <typename Shown>
Verdict tell_until(NetSession& session, Time deadline, const Shown& shown) {
    const OutputNeverWaits never;  // or the switch would leave events out, and nobody would say so
    for (;;) {
        for (const debug::Event& event : session.take_events()) {
            if (!shown(event)) continue;
            const bool json = session.options().json;
            const std::string line =
                json ? show_event_json(session, event) : show_event(session, event);
            if (!line.empty() && !print(line)) return kExitDone;
        }
        if (session.interrupted() || session.now() >= deadline) return kExitDone;
        (void)TRY(session.turn(deadline));
    }
}

Time end_of(const NetSession& session) {
    return session.options().wait_s ? session.now() + session.wait_or(0) : Time::max();
}

}  // namespace

Verdict net_watch(NetSession& session, const std::string& node,
                  const std::vector<std::string>& variables) {
    const debug::NodeId id = TRY(session.node(node));
    const std::vector<Wanted> wanted = TRY(wanted_of(session, id, variables));
    const Time end = end_of(session);
    for (const Wanted& variable : wanted) {
        (void)TRY(session.network().watch(id, {variable.typed, variable.range.address,
                                               variable.range.first, variable.range.count}));
    }
    return tell_until(session, end, [id](const debug::Event& event) {
        const bool gone = std::holds_alternative<debug::NodeDisconnected>(event.what) ||
                          std::holds_alternative<debug::NodeReconnected>(event.what);
        const bool changed = std::holds_alternative<debug::VariableChanged>(event.what);
        return event.node == id && (changed || gone);
    });
}

// Tells from the first moment on. Scripts become known when their nodes have described themselves.
Verdict net_log(NetSession& session, const std::vector<std::string>& named) {
    std::vector<debug::NodeId> only;
    session.hear_user_events();
    const bool all = named.empty() || std::find(named.begin(), named.end(), "all") != named.end();
    if (!all) only = TRY(session.nodes(named));
    const Time end = end_of(session);
    return tell_until(session, end, [&session, &only](const debug::Event& event) {
        if (std::holds_alternative<debug::NodeDescribed>(event.what)) session.adopt_scripts();
        return only.empty() || std::find(only.begin(), only.end(), event.node) != only.end();
    });
}

}  // namespace vagus::cli
