#include "serve/target/stopping.hpp"

#include "serve/json.hpp"

#include <algorithm>

namespace vagus::serve {

using State = StopNode::State;

const char* word_of(State state) {
    switch (state) {
        case State::Asked:
            return "asked";
        case State::Stopped:
            return "stopped";
        case State::Moving:
            return "moving";
        case State::Silent:
            return "silent";
        case State::Gone:
            return "gone";
    }
    return "";
}

nlohmann::json answer_of(const StopReport& report) {
    Json answer = {{"stood", Json::array()}, {"nodes", Json::array()}};
    for (const StopNode& one : report.nodes) {
        answer["nodes"].push_back(
            {{"node", one.node}, {"name", one.name}, {"state", word_of(one.state)}});
        if (one.state == State::Stopped) answer["stood"].push_back(one.node);
    }
    return answer;
}

std::vector<std::string> not_stopped(const nlohmann::json& answer) {
    std::vector<std::string> names;
    for (const Json& node : answer.value("nodes", Json::array())) {
        if (node["state"] == word_of(State::Stopped)) continue;
        const std::string name = node["name"];
        names.push_back(name.empty() ? "node " + node["node"].dump() : name);
    }
    return names;
}

void Stopping::begin(debug::Network& network, const session::SafeStop& safe,
                     const std::vector<uint16_t>& heard, bool link, Time now, Done done) {
    safe_ = safe;
    now_ = now;
    waiting_.push_back({std::move(done), now + kStopWithin});
    nodes_.read_moving_every(session::kMovesReadEvery);
    const session::Stopping::Manner manner{
        .until = session::Stopping::Until::Forgotten, .link = link, .strangers = heard};
    nodes_.begin(network, safe_, manner, now, session::all_nodes(network));
    answer();
}

void Stopping::end() {
    const std::vector<Waiting> all = std::exchange(waiting_, {});
    const StopReport last = report();
    for (const Waiting& one : all) one.done(last);
    nodes_.end();
}

void Stopping::tick(Time now) {
    now_ = std::max(now_, now);
    nodes_.tick(now);
    answer();
}

Time Stopping::next_tick() const {
    if (!waiting_.empty() && nodes_.settled()) return now_;
    Time next = nodes_.next_tick();
    for (const Waiting& one : waiting_) next = std::min(next, one.until);
    return next;
}

// What is known in the middle is no report: "asked" would be taken for an answer.
StopReport Stopping::report() const {
    return waiting_.empty() ? StopReport{nodes_.nodes()} : StopReport();
}

// Each that waits hears it once. What it does then may begin another Stop: so this is never called
// while a node is looked at.
void Stopping::answer() {
    std::vector<Done> due;
    const bool all = nodes_.settled();
    for (const Waiting& one : waiting_) {
        if (all || now_ >= one.until) due.push_back(one.done);
    }
    if (due.empty()) return;
    std::erase_if(waiting_, [&](const Waiting& one) { return all || now_ >= one.until; });
    if (waiting_.empty()) nodes_.read_moving_every(kMovesLongEvery);
    if (!all) nodes_.note_silence();
    const StopReport now{nodes_.nodes()};
    for (const Done& done : due) done(now);
}

}  // namespace vagus::serve
