#include "serve/history/event_past.hpp"

#include "serve/json.hpp"

#include <algorithm>

namespace vagus::serve {

namespace {

size_t bytes_of(const Happened& event) {
    return sizeof(Happened) + event.kind.size() + event.source.size() + event.name.size() +
           event.text.size() + event.args.size() * sizeof(int16_t);
}

// Marks of one pixel become one at once, so that a flood makes no long list.
void add_mark(std::deque<Mark>& marks, const Happened& event, double pixel) {
    const bool joins = !marks.empty() && event.t - marks.back().t < pixel;
    if (!joins) return marks.push_back({event.t, event.name});
    ++marks.back().count;
    if (marks.back().name != event.name) marks.back().name.clear();
}

}  // namespace

void EventPast::add(Happened event) {
    event.t = to_ = std::max(to_, event.t);
    if (event.kind == "state") note_state(event);
    bytes_ += bytes_of(event);
    events_.push_back(std::move(event));
    const auto full = [&] {
        return events_.size() > kPastEvents || bytes_ > kPastEventBytes ||
               events_.front().t < to_ - kPastEventSeconds;
    };
    while (events_.size() > 1 && full()) {
        bytes_ -= bytes_of(events_.front());
        events_.pop_front();
        ++first_;
    }
}

void EventPast::cut(double t) {
    while (!events_.empty() && events_.back().t > t) {
        bytes_ -= bytes_of(events_.back());
        events_.pop_back();
    }
    for (auto& [node, states] : states_) {
        while (!states.empty() && states.back().t > t) states.pop_back();
    }
    to_ = std::min(to_, t);
}

Json EventPast::until(double t, size_t most) const {
    const auto end =
        std::upper_bound(events_.begin(), events_.end(), t,
                         [](double instant, const Happened& event) { return instant < event.t; });
    const auto count = static_cast<size_t>(end - events_.begin());
    Json list = Json::array();
    for (size_t i = count - std::min(count, most); i < count; ++i) {
        list.push_back(happening_json(events_[i]));
        list.back()["number"] = first_ + i;
    }
    return list;
}

std::vector<Json> EventPast::lanes(const LaneWindow& window, size_t& left_out) const {
    std::map<std::string, Lane> lanes;
    auto event =
        std::lower_bound(events_.begin(), events_.end(), window.from,
                         [](const Happened& one, double instant) { return one.t < instant; });
    for (; event != events_.end() && event->t <= window.to; ++event) {
        if (event->kind != "event") continue;
        if (!lanes.contains(event->source) && lanes.size() >= kEventLanesMax) {
            ++left_out;
            continue;
        }
        add_mark(lanes[event->source].marks, *event, window.pixel());
    }
    std::vector<Json> found;
    for (auto& [source, lane] : lanes) {
        lane.kind = "events";
        lane.name = source;
        found.push_back(lane.shown_in_runs(window));
    }
    return found;
}

void EventPast::note_state(const Happened& event) {
    if (!states_.contains(event.node) && states_.size() >= kNodesKept) return;
    std::deque<NodeState>& states = states_[event.node];
    states.push_back({event.t, event.name, event.line});
    if (states.size() > kNodeStatesKept) states.pop_front();
}

Json EventPast::nodes_at(double t) const {
    Json nodes = Json::array();
    for (const auto& [node, states] : states_) {
        const auto after =
            std::upper_bound(states.begin(), states.end(), t,
                             [](double instant, const NodeState& one) { return instant < one.t; });
        if (after == states.begin()) continue;
        const NodeState& last = *std::prev(after);
        Json one = {{"node", node}, {"state", last.state}};
        if (last.line > 0) one["line"] = last.line;
        nodes.push_back(std::move(one));
    }
    return nodes;
}

}  // namespace vagus::serve
