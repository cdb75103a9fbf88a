#include "debug/roll_call.hpp"

#include <algorithm>
#include <utility>

namespace vagus::debug {

RollCall::RollCall(Network& network, Time now, RollCallOptions options)
    : options_(std::move(options)), start_(now), last_answer_(now), call_again_(now + kListEvery) {
    network.tick(now);
    next_ = end(network);
}

void RollCall::hear(const Event& event) {
    const bool appeared = std::holds_alternative<NodeAppeared>(event.what);
    if (std::holds_alternative<DescriptionFailed>(event.what)) silent_.insert(event.node);
    if (appeared) slowest_ = std::max(slowest_, event.at - start_);
    if (!appeared && !std::holds_alternative<NodeDescribed>(event.what)) return;
    answered_ = true;
    last_answer_ = std::max(last_answer_, event.at);
}

// It can be worked with, or will never say what it is.
bool RollCall::has(const Network& network, NodeId id) const {
    const NodeView* node = network.node(id);
    if (node == nullptr || !node->connected) return false;
    const bool ready = node->described && node->state != ProgramState::Unknown;
    return ready || silent_.contains(id);
}

bool RollCall::has_wanted(const Network& network) const {
    return std::all_of(options_.wanted.begin(), options_.wanted.end(),
                       [&](NodeId id) { return has(network, id); });
}

// A slow board describes itself part by part.
Time RollCall::last_sign(const Network& network, NodeId id) const {
    const NodeView* node = network.node(id);
    return node == nullptr ? last_answer_ : std::max(last_answer_, node->part_at);
}

Time RollCall::end(const Network& network) const {
    Time end = last_answer_ + std::max(options_.quiet, std::min(slowest_, kNodesWithin));
    if (!answered_) end = std::max(end, start_ + options_.first_within);
    for (const NodeId id : options_.wanted) {
        if (!has(network, id)) end = std::max(end, last_sign(network, id) + kWantedWithin);
    }
    const Duration within = std::max(kNodesWithin, options_.quiet);
    if (network.examines_ids()) end = std::max(end, last_answer_ + within);
    for (const NodeId id : network.nodes()) {
        if (has(network, id) || !network.node(id)->connected) continue;
        end = std::max(end, last_sign(network, id) + within);
    }
    return std::min(end, start_ + std::max(kRollCallMax, options_.quiet));
}

bool RollCall::over(Network& network, Time now) {
    if (options_.only_wanted && has_wanted(network)) return true;
    if (now >= call_again_) {
        call_again_ = now + kListEvery;
        for (const NodeId id : options_.wanted) network.call(id);
    }
    next_ = end(network);
    if (now < next_) {
        next_ = std::min(next_, call_again_);
        return false;
    }
    // Somebody answered twice: is it two nodes?
    if (!network.doubts_an_id() || std::exchange(settled_ids_, true)) return true;
    network.list_nodes();
    last_answer_ = now;
    next_ = now + options_.quiet;
    return false;
}

}  // namespace vagus::debug
