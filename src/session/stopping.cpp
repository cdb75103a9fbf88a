#include "session/stopping.hpp"

#include <algorithm>
#include <utility>

namespace vagus::session {

using State = StopNode::State;

namespace {

std::string list(const std::vector<StopNode>& nodes, State state) {
    std::string text;
    for (const StopNode& node : nodes) {
        if (node.state != state) continue;
        const std::string id = std::to_string(node.node);
        text += text.empty() ? "" : ", ";
        text += node.name.empty() ? "node " + id : node.name + " (" + id + ")";
    }
    return text;
}

}  // namespace

std::string describe(const std::vector<StopNode>& nodes) {
    constexpr std::pair<State, const char*> kWords[] = {{State::Stopped, "at rest: "},
                                                        {State::Moving, "still moving: "},
                                                        {State::Silent, "did not answer: "},
                                                        {State::Gone, "not there any more: "}};
    std::string text;
    for (const auto& [state, word] : kWords) {
        const std::string names = list(nodes, state);
        if (!names.empty()) text += (text.empty() ? "" : "; ") + (word + names);
    }
    return text;
}

std::vector<debug::NodeId> all_nodes(const debug::Network& network) {
    std::vector<debug::NodeId> nodes = network.nodes();
    for (const auto& [id, name] : network.left()) nodes.push_back(id);
    return nodes;
}

void Stopping::begin(debug::Network& network, const SafeStop& safe, How how, Time now) {
    // What is away gets its Stop all the same: it may hear.
    if (how == How::Stop) return begin(network, safe, Manner{}, now, all_nodes(network));
    std::vector<debug::NodeId> nodes;
    for (const debug::NodeId id : network.nodes()) {
        const debug::NodeView& view = *network.node(id);
        if (view.connected && safe.contains(view.name)) nodes.push_back(id);
    }
    begin(network, safe, Manner{.how = how}, now, nodes);
}

// All are told to stop before anything else is said to any of them.
void Stopping::begin(debug::Network& network, const SafeStop& safe, const Manner& manner, Time now,
                     const std::vector<debug::NodeId>& nodes) {
    network_ = &network;
    safe_ = &safe;
    manner_ = manner;
    now_ = now;
    nodes_.clear();
    const std::vector<std::pair<debug::NodeId, std::string>> left = network.left();
    const std::map<debug::NodeId, std::string> names(left.begin(), left.end());
    for (const debug::NodeId id : nodes) {
        Node& node = nodes_[id];
        const debug::NodeView* view = network.node(id);
        const auto known = names.find(id);
        if (view) node.name = view->name;
        if (known != names.end()) node.name = known->second;
        const bool away = (view && !view->connected) || known != names.end();
        if (away && manner.link) node.state = State::Gone;
        if (manner.how == How::Stop) node.stop = network.stop_now(id);
        node.halted = manner.how != How::Stop;
        node.next = now + kStopAgain;
    }
    for (const debug::NodeId id : manner.strangers) {
        if (!nodes_.contains(id)) (void)network.stop_now(id);
    }
    for (auto& [id, node] : nodes_) {
        make_safe(id, node);
        if (node.halted) read(id, node);
    }
}

void Stopping::end() {
    nodes_.clear();
    network_ = nullptr;
}

void Stopping::ask(debug::NodeId id, Node& node) {
    node.next = now_ + kStopAgain;
    if (manner_.how == How::Stop) {
        node.halted = false;
        node.stop = network_->stop_now(id);
    }
    make_safe(id, node);
    if (node.halted) read(id, node);
}

// Behind Stop: a script that runs would write over it. A node that has not told its name yet gets
// it when it has.
void Stopping::make_safe(debug::NodeId id, Node& node) {
    node.checks.clear();
    node.read_once = false;
    const debug::NodeView* view = network_->node(id);
    node.knows_checks = view && view->described;
    if (!node.knows_checks) return;
    node.name = view->name;
    const auto found = safe_->find(view->name);
    if (found == safe_->end()) return;
    for (const auto& [name, values] : found->second.set) {
        const auto range = network_->variable(id, name);
        if (!range.ok()) continue;  // a node of that name without it
        debug::VariableRange written = range.value();
        written.count = static_cast<uint16_t>(std::min<size_t>(values.size(), written.count));
        const std::vector<int16_t> wanted(values.begin(), values.begin() + written.count);
        if (manner_.how != How::Look) (void)network_->write(id, written, wanted).ok();
        node.checks.push_back({.range = written, .wanted = wanted, .written = true});
    }
    for (const std::string& name : found->second.read) {
        const auto range = network_->variable(id, name);
        if (!range.ok()) continue;
        const std::vector<int16_t> zeros(range.value().count);
        node.checks.push_back({.range = range.value(), .wanted = zeros});
    }
}

// Only behind the answer to Stop: what comes before it may have been asked before, and is of a
// script that still ran.
void Stopping::read(debug::NodeId id, Node& node) {
    node.next = now_ + kStopAgain;
    for (Check& check : node.checks) {
        check.good.reset();
        const auto asked = network_->get(id, check.range);
        check.asked = asked.ok() ? std::optional(asked.value()) : std::nullopt;
    }
    judge(id, node);
}

void Stopping::judge(debug::NodeId id, Node& node) {
    if (!node.halted || !node.knows_checks) return;
    const auto& checks = node.checks;
    const auto known = [](const Check& check) { return check.good.has_value(); };
    if (!std::all_of(checks.begin(), checks.end(), known)) return;
    const auto good = [](const Check& check) { return *check.good; };
    if (std::all_of(checks.begin(), checks.end(), good)) {
        if (manner_.how != How::Rest || checks.empty() || std::exchange(node.read_once, true)) {
            node.state = State::Stopped;
        } else {
            node.next = now_ + kRestHolds;
        }
        return;
    }
    node.read_once = false;
    node.state = State::Moving;
    node.next = now_ + moves_every_;
    if (manner_.how == How::Look || node.known_of) return;
    for (const Check& check : checks) {
        const bool again = check.written && !*check.good;
        if (again) (void)network_->write(id, check.range, check.wanted).ok();
    }
}

// It has answered, but not who it is: that is no silence.
void Stopping::no_answer(Node& node) {
    if (node.state == State::Gone) return;
    node.state = node.halted && !node.knows_checks ? State::Asked : State::Silent;
}

// An insistent stop asks at the next tick, with all else that is due.
void Stopping::come_back(debug::NodeId id, Node& node) {
    if (insists()) {
        node.next = now_;
        return;
    }
    node.state = State::Asked;
    ask(id, node);
}

std::optional<debug::NodeId> Stopping::hear(const debug::Event& event) {
    const auto found = nodes_.find(event.node);
    if (found == nodes_.end()) return std::nullopt;
    now_ = std::max(now_, event.at);
    auto& [id, node] = *found;
    if (has_come_to_rest(node) && !insists()) return std::nullopt;
    if (const auto* done = std::get_if<debug::RequestDone>(&event.what)) {
        if (node.stop != done->request || done->error) return std::nullopt;
        node.stop.reset();
        node.halted = true;
        read(id, node);
        return id;
    }
    if (const auto* came = std::get_if<debug::VariablesArrived>(&event.what)) {
        for (Check& check : node.checks) {
            if (check.asked != came->request) continue;
            check.asked.reset();
            check.good = came->values == check.wanted;
            judge(id, node);
            break;
        }
    } else if (std::holds_alternative<debug::NodeDescribed>(event.what)) {
        make_safe(id, node);
        if (node.halted) read(id, node);
    } else if (std::holds_alternative<debug::NodeReconnected>(event.what)) {
        if (node.state != State::Stopped) come_back(id, node);
    } else if (const auto* away = std::get_if<debug::NodeDisconnected>(&event.what)) {
        const bool gone = away->forgotten || !insists();
        if (gone && node.state != State::Stopped) node.state = State::Gone;
    }
    return std::nullopt;
}

void Stopping::tick(Time now) {
    now_ = std::max(now_, now);
    for (auto& [id, node] : nodes_) {
        if (!is_asked_on(node) || now_ < node.next) continue;
        const bool waits = std::any_of(node.checks.begin(), node.checks.end(),
                                       [](const Check& one) { return one.asked.has_value(); });
        if ((node.state == State::Moving || node.read_once) && !waits) {
            read(id, node);
        } else {
            no_answer(node);
            ask(id, node);
        }
    }
}

Time Stopping::next_tick() const {
    Time next = Time::max();
    for (const auto& [id, node] : nodes_) {
        if (is_asked_on(node)) next = std::min(next, node.next);
    }
    return next;
}

void Stopping::forget(debug::NodeId node) {
    nodes_.erase(node);
}

void Stopping::acknowledge() {
    for (auto& [id, node] : nodes_) node.known_of = node.state != State::Stopped;
}

void Stopping::let_move() {
    for (auto& [id, node] : nodes_) node.known_of = node.known_of || node.state == State::Moving;
}

bool Stopping::has_come_to_rest(const Node& node) const {
    return node.state == State::Stopped ||
           (manner_.how == How::Look && node.state == State::Moving);
}

bool Stopping::is_asked_on(const Node& node) const {
    const bool given_up = node.state == State::Gone && !insists();
    return !has_come_to_rest(node) && !given_up && !node.known_of;
}

bool Stopping::settled() const {
    return std::all_of(nodes_.begin(), nodes_.end(), [this](const auto& one) {
        return has_come_to_rest(one.second) || one.second.state == State::Gone;
    });
}

std::vector<StopNode> Stopping::report() const {
    std::vector<StopNode> report = nodes();
    for (StopNode& one : report) {
        if (one.state == State::Asked) one.state = State::Silent;
    }
    return report;
}

std::vector<StopNode> Stopping::nodes() const {
    std::vector<StopNode> nodes;
    for (const auto& [id, node] : nodes_) nodes.push_back({id, node.name, node.state});
    return nodes;
}

std::optional<State> Stopping::state_of(debug::NodeId node) const {
    const auto found = nodes_.find(node);
    if (found == nodes_.end() || found->second.known_of) return std::nullopt;
    return found->second.state;
}

void Stopping::note_silence() {
    for (auto& [id, node] : nodes_) {
        if (node.state == State::Asked) no_answer(node);
    }
}

}  // namespace vagus::session
