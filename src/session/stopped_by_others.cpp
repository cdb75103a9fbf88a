#include "session/stopped_by_others.hpp"

#include <algorithm>
#include <utility>

namespace vagus::session {

// An event that waits for a stopped program makes it a paused one: it still does nothing. So does a
// reset, and a pause. At a breakpoint somebody looks for a mistake, and lets it run again. A node
// that is away is another matter, and so is what it does when it is back.
void StoppedByOthers::hear(const debug::Event& event) {
    if (std::holds_alternative<debug::NodeDisconnected>(event.what)) stopped_.erase(event.node);
    const auto* changed = std::get_if<debug::StateChanged>(&event.what);
    if (!changed) return;
    if (changed->state == debug::ProgramState::Running) {
        ran_.insert(event.node);
        stopped_.erase(event.node);
    } else if (!changed->at_breakpoint && ran_.contains(event.node)) {
        stopped_.emplace(event.node, event.at);
    }
}

void StoppedByOthers::hold(std::set<debug::NodeId> nodes, Time now) {
    const auto before = std::exchange(held_, std::move(nodes));
    for (auto& [node, since] : stopped_) {
        if (before.contains(node) && !held_.contains(node)) since = now;
    }
}

std::vector<debug::NodeId> StoppedByOthers::take_due(Time now) {
    std::vector<debug::NodeId> due;
    for (const auto& [node, since] : stopped_) {
        if (now >= since + within_ && !held_.contains(node)) due.push_back(node);
    }
    for (const debug::NodeId node : due) stopped_.erase(node);
    return due;
}

Time StoppedByOthers::next() const {
    Time next = Time::max();
    for (const auto& [node, since] : stopped_) {
        if (!held_.contains(node)) next = std::min(next, since + within_);
    }
    return next;
}

}  // namespace vagus::session
