#include "session/bus_ears.hpp"

#include "wire/protocol.hpp"

namespace vagus::session {

BusEars::~BusEars() {
    for (const auto& [node, known] : known_) {
        if (known.there) nodes_.left(known.name);
    }
}

std::optional<run::BusEvent> BusEars::hear(const debug::Event& event) {
    const bool of_a_host = event.node == wire::kHostId;
    if (!only_.empty() && !of_a_host && !only_.contains(event.node)) return std::nullopt;
    if (const auto* sent = std::get_if<debug::UserEvent>(&event.what)) {
        if (sent->name.empty()) return std::nullopt;
        return run::BusEvent{sent->name, sent->arguments, event.node};
    }
    if (const auto* described = std::get_if<debug::NodeDescribed>(&event.what)) {
        const auto before = gone(event.node);  // it came back, perhaps under another name
        const bool renamed = known_[event.node].name != described->name;
        known_[event.node].name = described->name;
        there(event.node);
        return renamed ? before : std::nullopt;
    }
    if (std::holds_alternative<debug::NodeReconnected>(event.what)) there(event.node);
    if (std::holds_alternative<debug::NodeDisconnected>(event.what)) return gone(event.node);
    return std::nullopt;
}

void BusEars::there(debug::NodeId node) {
    const auto found = known_.find(node);
    if (found == known_.end() || found->second.there) return;
    found->second.there = true;
    nodes_.appeared(found->second.name);
}

std::optional<run::BusEvent> BusEars::gone(debug::NodeId node) {
    const auto found = known_.find(node);
    if (found == known_.end() || !found->second.there) return std::nullopt;
    found->second.there = false;
    if (!nodes_.left(found->second.name)) return std::nullopt;
    return run::BusEvent{toolbox::node_left(found->second.name), {}, node};
}

}  // namespace vagus::session
