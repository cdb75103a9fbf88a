#include "session/bus_ears.hpp"

#include "wire/protocol.hpp"

namespace vagus::session {

BusEars::~BusEars() {
    for (const auto& [node, known] : known_) {
        if (known.there) nodes_.left(known.name);
        if (known.told_stopped) nodes_.runs(known.name);
    }
}

std::optional<run::BusEvent> BusEars::hear(const debug::Event& event) {
    const bool of_a_host = event.node == wire::kHostId;
    if (!only_.empty() && !of_a_host && !only_.contains(event.node)) return std::nullopt;
    if (const auto* sent = std::get_if<debug::UserEvent>(&event.what)) {
        if (sent->name.empty()) return std::nullopt;
        return run::BusEvent{sent->name, sent->arguments, event.node, event.frame};
    }
    if (const auto* described = std::get_if<debug::NodeDescribed>(&event.what)) {
        const auto before = gone(event.node);  // it came back, perhaps under another name
        Known& known = known_[event.node];
        const bool renamed = known.name != described->name;
        if (known.told_stopped && renamed) nodes_.runs(known.name);
        known.name = described->name;
        if (known.told_stopped) nodes_.stopped(known.name);
        there(event.node);
        return renamed ? before : std::nullopt;
    }
    if (std::holds_alternative<debug::NodeReconnected>(event.what)) there(event.node);
    if (std::holds_alternative<debug::NodeDisconnected>(event.what)) return gone(event.node);
    if (const auto* changed = std::get_if<debug::StateChanged>(&event.what)) {
        return hear_state(event.node, *changed);
    }
    return std::nullopt;
}

// An event that waits for a stopped program makes it a paused one: it still does nothing. So does a
// reset, and a pause. At a breakpoint somebody looks for a mistake, and lets it run again.
std::optional<run::BusEvent> BusEars::hear_state(debug::NodeId node,
                                                 const debug::StateChanged& changed) {
    if (changed.at_breakpoint) return std::nullopt;
    Known& known = known_[node];
    const bool runs = changed.state == debug::ProgramState::Running;
    known.ran |= runs;
    // One that has no program yet was not stopped by anybody.
    known.stopped = known.ran && !runs;
    return tell_stopped(node, known);
}

std::vector<run::BusEvent> BusEars::hold(std::set<debug::NodeId> nodes) {
    held_ = std::move(nodes);
    std::vector<run::BusEvent> told;
    for (auto& [node, known] : known_) {
        if (auto one = tell_stopped(node, known)) told.push_back(std::move(*one));
    }
    return told;
}

std::optional<run::BusEvent> BusEars::tell_stopped(debug::NodeId node, Known& known) {
    const bool stopped = known.stopped && !held_.contains(node);
    if (std::exchange(known.told_stopped, stopped) == stopped || known.name.empty()) {
        return std::nullopt;
    }
    if (stopped) {
        nodes_.stopped(known.name);
        return run::BusEvent{toolbox::node_stopped(known.name), {}, node};
    }
    nodes_.runs(known.name);
    return run::BusEvent{toolbox::node_runs(known.name), {}, node};
}

void BusEars::there(debug::NodeId node) {
    const auto found = known_.find(node);
    if (found == known_.end() || found->second.there || found->second.name.empty()) return;
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
