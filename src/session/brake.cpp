#include "session/brake.hpp"

#include <algorithm>
#include <utility>

#include "debug/program_mark.hpp"

namespace vagus::session {

namespace {

constexpr const char* kHaltedEvent = "halted";

bool runs(const debug::NodeView& node) {
    return node.connected && node.state == debug::ProgramState::Running;
}

}  // namespace

bool halts_itself(const debug::NodeView& node) {
    const auto& events = node.target->local_events;
    return node.described && std::any_of(events.begin(), events.end(), [](const auto& event) {
               return event.name == kHaltedEvent;
           });
}

bool moves(const debug::NodeView& node, const SafeStop& safe) {
    return node.described && (safe.contains(node.name) || halts_itself(node));
}

bool may_move_unread(const debug::NodeView& node, const SafeStop& safe) {
    if (!runs(node) || safe.contains(node.name)) return false;
    if (!node.described) return true;
    return halts_itself(node) || !debug::mark_address(node.target);
}

void make_safe(debug::Network& network, const SafeStop& safe, debug::NodeId node) {
    const debug::NodeView* view = network.node(node);
    const auto found = view ? safe.find(view->name) : safe.end();
    if (found == safe.end()) return;
    for (const auto& [name, values] : found->second.set) {
        const auto range = network.variable(node, name);
        if (!range.ok()) continue;  // a node of that name without it
        const size_t count = std::min<size_t>(values.size(), range.value().count);
        (void)network.write(node, range.value(), std::span(values).first(count)).ok();
    }
}

std::vector<debug::NodeId> others_that_move(const debug::Network& network, const SafeStop& safe,
                                            const std::set<debug::NodeId>& causes) {
    std::vector<debug::NodeId> others;
    for (const debug::NodeId id : network.nodes()) {
        const debug::NodeView& node = *network.node(id);
        if (!causes.contains(id) && runs(node) && moves(node, safe)) others.push_back(id);
    }
    return others;
}

void Brake::begin(const debug::Network& network) {
    causes_.clear();
    braked_.clear();
    ran_.clear();
    for (const debug::NodeId id : network.nodes()) {
        if (runs(*network.node(id))) ran_.insert(id);
    }
}

Brake::Orders Brake::hear(const debug::Network& network, const SafeStop& safe,
                          const debug::Event& event) {
    const debug::NodeId id = event.node;
    if (std::holds_alternative<debug::NodeDisconnected>(event.what)) {
        return miss(network, safe, id, Why::Lost);
    }
    // Its state is told only if it is another one than before.
    const debug::NodeView* node = network.node(id);
    if (std::holds_alternative<debug::NodeConfirmed>(event.what) && node && runs(*node)) {
        return there_again(id);
    }
    const auto* changed = std::get_if<debug::StateChanged>(&event.what);
    if (!changed) return {};
    if (changed->state == debug::ProgramState::Running) return there_again(id);
    return miss(network, safe, id, changed->at_breakpoint ? Why::Breakpoint : Why::Stopped);
}

// What was paused here is not missed for that; if it is lost, it is.
Brake::Orders Brake::miss(const debug::Network& network, const SafeStop& safe, debug::NodeId node,
                          Why why) {
    if (!ran_.contains(node)) return {};
    if (why == Why::Lost) {
        braked_.erase(node);
    } else if (braked_.contains(node)) {
        return {};
    }
    const auto [cause, is_new] = causes_.insert_or_assign(node, why);
    if (!is_new) return {};
    Orders orders{.cause = node, .pause = {}, .make_safe = {}, .run = {}};
    std::set<debug::NodeId> causes;
    for (const auto& [id, its_why] : causes_) causes.insert(id);
    for (const debug::NodeId other : others_that_move(network, safe, causes)) {
        if (!braked_.insert(other).second) continue;
        orders.pause.push_back(other);
        orders.make_safe.push_back(other);
    }
    const debug::NodeView* view = network.node(node);
    if (view && view->connected && moves(*view, safe)) orders.make_safe.push_back(node);
    return orders;
}

// A node that somebody else lets run meanwhile runs.
Brake::Orders Brake::there_again(debug::NodeId node) {
    ran_.insert(node);
    braked_.erase(node);
    Orders orders;
    if (causes_.erase(node) == 0 || !causes_.empty()) return orders;
    const auto paused = std::exchange(braked_, {});
    orders.run.assign(paused.begin(), paused.end());
    return orders;
}

bool Brake::at_breakpoint() const {
    return std::any_of(causes_.begin(), causes_.end(),
                       [](const auto& cause) { return cause.second == Why::Breakpoint; });
}

std::string name_with_id(const debug::Network& network, debug::NodeId node) {
    const debug::NodeView* view = network.node(node);
    const std::string id = std::to_string(node);
    return view && !view->name.empty() ? view->name + " (" + id + ")" : "node " + id;
}

}  // namespace vagus::session
