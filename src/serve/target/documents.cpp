// What pages see of the robot: documents made from what is known now.
#include <fmt/format.h>

#include <algorithm>

#include "aesl/mentions.hpp"
#include "serve/json.hpp"
#include "serve/target/known_variables.hpp"
#include "serve/target/shared_id.hpp"
#include "serve/target/target.hpp"

namespace vagus::serve {

namespace {

constexpr uint16_t kHost = 0;  // in the place of a node: this program, and the plan

const char* word_of(Connection connection) {
    switch (connection) {
        case Connection::Connecting:
            return "connecting";
        case Connection::Connected:
            return "connected";
        case Connection::Lost:
            return "lost";
        case Connection::Failed:
            return "failed";
    }
    return "none";
}

void describe(Json& variable, const KnownVariable* known) {
    if (!known) return;
    variable["writable"] = known->writable;
    variable["help"] = known->help;
    if (!known->unit.empty()) variable["unit"] = known->unit;
}

}  // namespace

void Target::declare_topics() {
    Topics& topics = desk_.topics();
    topics.document("robot", [this](const Json&) { return target_document(); });
    topics.document("node", [this](const Json& of) { return node_document(of); });
    topics.document("network", [this](const Json&) { return network_document(); });
    topics.stream("happenings", Protocol::get().limit("events_kept"));
    declare_watches();
}

Json Target::node_line(uint16_t id) const {
    const debug::NodeView* view = network_->node(id);
    Json node = {{"id", id},
                 {"name", view->name},
                 {"robot", hints_.robot_of(id)},
                 {"state", view->connected ? debug::name_of(view->state) : "gone"},
                 {"protocol", view->protocol},
                 {"described", view->described}};
    const std::string doc = doc_of(id);
    if (!doc.empty()) node["doc"] = doc;
    const auto found = known_.find(id);
    const Known known = found == known_.end() ? Known{} : found->second;
    // Events pause a stopped node at their first line; it is stopped all the same.
    const bool stopped = known.stopped && view->connected;
    if (stopped) node["state"] = "stopped";
    // Paused between two events: at no line.
    const bool waits = view->connected && view->state == debug::ProgramState::Stopped && !stopped &&
                       known.fault.empty();
    if (waits) node["state"] = "paused";
    const CompiledScript* script = doc.empty() ? nullptr : scripts_.compiled(doc);
    node["program"] = known.away || known.in_doubt ? "unknown"
                      : !known.has_program         ? (view->program ? "unknown" : "none")
                      : script && script->source == known.loaded ? "current"
                                                                 : "older";
    if (known.loaded_wall > 0) node["loaded_wall"] = known.loaded_wall;
    const bool paused =
        view->state == debug::ProgramState::Paused || view->state == debug::ProgramState::Stopped;
    // After a fault the next event is begun and waits: its line is not that of the mistake.
    const bool faulty = known.why == "fault" && known.fault_line > 0;
    const int line = faulty ? known.fault_line : view->at.line;
    if (paused && !stopped && !waits && line > 0) node["at"] = {{"line", line}, {"column", 1}};
    if (paused && !known.why.empty()) node["why"] = known.why;
    if (!known.fault.empty()) node["fault"] = known.fault;
    if (const auto dropped = dropped_.of(id)) node["dropped"] = *dropped;
    if (!known.busy.empty()) node["busy"] = known.busy;
    if (const auto stop = stopping_.state_of(id)) {
        node["stop"] = word_of(*stop);
        if (*stop == StopNode::State::Asked) node["busy"] = "stopping";
    }
    // Its script runs on behind a plan; nobody has said that it is at rest.
    const auto rest = resting_.state_of(id);
    if (rest == StopNode::State::Silent || rest == StopNode::State::Gone) {
        node["stop"] = word_of(*rest);
    }
    return node;
}

Json Target::target_document() const {
    Json nodes = Json::array();
    Json twins = Json::array();
    if (network_) {
        for (const debug::NodeId node : network_->nodes()) {
            nodes.push_back(node_line(node));
            const debug::NodeView& view = *network_->node(node);
            if (view.id_shared) twins.push_back(shared_id_words(view));
        }
    }
    Json robot = {{"target", target_},
                  {"name", name_},
                  {"kind", kind_},
                  {"state", carrier_ ? word_of(state()) : "none"},
                  {"nodes", std::move(nodes)},
                  {"twins", std::move(twins)},
                  {"lost", network_ ? network_->counts().dropped : 0},
                  {"events_a_second", events_a_second_}};
    if (const std::string why = why_lost(); !why.empty()) robot["why"] = why;
    if (const auto load = hints_.load()) robot["load"] = *load;
    return robot;
}

Json Target::node_document(const Json& of) const {
    const uint16_t id = of["node"];
    const debug::NodeView* view = network_ ? network_->node(id) : nullptr;
    Json document = {{"name", ""},
                     {"variables", Json::array()},
                     {"events", Json::array()},
                     {"natives", Json::array()}};
    if (!view || !view->described) return document;
    document["name"] = view->name;
    uint16_t address = 0;
    const auto add = [&](const std::string& name, uint16_t size, uint16_t at, const char* owner) {
        document["variables"].push_back(
            {{"name", name}, {"address", at}, {"size", size}, {"of", owner}, {"writable", true}});
    };
    for (const aesl::NamedVariable& variable : view->target->variables) {
        add(variable.name, variable.size, address, "node");
        describe(document["variables"].back(), known_variable(view->name, variable.name));
        address = static_cast<uint16_t>(address + variable.size);
    }
    if (view->program) {
        for (const aesl::VariablePlace& place : view->program->variables) {
            if (place.address >= address) add(place.name, place.size, place.address, "script");
        }
    }
    for (const aesl::LocalEvent& event : view->target->local_events) {
        document["events"].push_back({{"name", event.name}, {"help", event.doc}});
    }
    for (const aesl::NativeFunction& native : view->target->natives) {
        Json parameters = Json::array();
        for (const aesl::NativeParameter& one : native.parameters) {
            parameters.push_back({{"name", one.name}, {"size", one.size}});
        }
        document["natives"].push_back(
            {{"name", native.name}, {"help", native.doc}, {"parameters", std::move(parameters)}});
    }
    return document;
}

Json Target::network_document() const {
    // Nodes whose scripts have a handler, by event.
    std::map<std::string, std::vector<uint16_t>> handlers;
    for (const uint16_t node : live_nodes()) {
        const CompiledScript* script = scripts_.compiled(doc_of(node));
        if (!script) continue;
        for (const auto& mention : aesl::mentions(script->source, script->common)) {
            if (mention.handles) handlers[mention.name].push_back(node);
        }
    }
    Json traffic = Json::array();
    for (const auto& [said, count] : traffic_) {
        std::vector<uint16_t> to = handlers[said.second];
        if (said.first != kHost && hints_.plan_hears(said.second)) to.insert(to.begin(), kHost);
        traffic.push_back({{"from", said.first},
                           {"event", said.second},
                           {"count", count},
                           {"to", std::move(to)}});
    }
    Json links = Json::array();
    for (const LinkView& link : carrier_ ? carrier_->links() : std::vector<LinkView>()) {
        links.push_back({{"name", link.name},
                         {"nodes", link.nodes},
                         {"frames_in", link.frames_in},
                         {"frames_out", link.frames_out},
                         {"lost", link.lost}});
    }
    return {{"links", std::move(links)}, {"traffic", std::move(traffic)}};
}

Json Target::breakpoints_list() const {
    Json list = Json::array();
    for (const ScriptBreakpoint& one : breakpoints_.all()) {
        if (one.once) continue;
        Json json = {{"doc", one.doc},       {"line", one.line},       {"condition", one.condition},
                     {"ignore", one.ignore}, {"enabled", one.enabled}, {"hits", one.hits},
                     {"set", one.set}};
        if (!one.why.empty()) json["why"] = one.why;
        list.push_back(std::move(json));
    }
    return list;
}

}  // namespace vagus::serve
