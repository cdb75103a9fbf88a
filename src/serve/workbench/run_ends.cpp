#include "serve/workbench/run_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "serve/json.hpp"
#include "serve/target/stopping.hpp"
#include "session/stop_node_name.hpp"

namespace vagus::serve {

using life::Why;

namespace {

constexpr size_t kByMax = 100;  // bytes, as the protocol has it
constexpr size_t kMessageMax = 2000;
constexpr size_t kNamedMax = 8;  // nodes in one sentence

bool is_missing(const StopNode& node) {
    return node.state != StopNode::State::Stopped;
}

std::string who_stopped(const life::Cause& cause) {
    switch (cause.why) {
        case Why::Plan:
            return "the plan has ended";
        case Why::Error:
            return "the plan ended in an error; the nodes were stopped";
        case Why::Died:
            return "the nodes were stopped, since the plan that used them is gone";
        case Why::Signal:
            return "stopped by the signal " + cause.by;
        case Why::Target:
            return fmt::format("stopped, since {} leaves the robot", cause.by);
        case Why::Project:
            return fmt::format("stopped, since {} closes the project", cause.by);
        case Why::Version:
            return "stopped for another version of the project";
        case Why::Alone:
            return "stopped, since the last page was closed";
        case Why::Slept:
            return "stopped, since this computer slept";
        case Why::Stop:
        case Why::Before:
            break;
    }
    return "stopped by " + cause.by;
}

// "; at rest: drive (1), bumper (2) and 3 more"
std::string who_rests(const std::vector<StopNode>& nodes) {
    std::string text;
    size_t count = 0;
    for (const StopNode& node : nodes) {
        if (is_missing(node) || ++count > kNamedMax) continue;
        text += fmt::format("{}{} ({})", text.empty() ? "; at rest: " : ", ", node.name, node.node);
    }
    if (count > kNamedMax) text += fmt::format(" and {} more", count - kNamedMax);
    return text;
}

}  // namespace

Json nodes_json(const std::vector<StopNode>& nodes) {
    Json list = Json::array();
    for (const StopNode& one : nodes) {
        list.push_back({{"node", one.node}, {"name", one.name}, {"state", word_of(one.state)}});
    }
    return list;
}

RunEnds::RunEnds() {
    for (const Why why : life::kWhys) counts_[life::name_of(why)] = 0;
}

void RunEnds::add(const life::End& end, double t, double wall_ms) {
    last_.emplace(Told{end, t, wall_ms});
    acknowledged_ = false;
    ++counts_[life::name_of(end.cause.why)];
    if (!end.result.empty()) ++results_[end.result];
}

void RunEnds::renew(const life::End& end) {
    if (last_ && last_->end.number == end.number) last_->end.nodes = end.nodes;
}

bool RunEnds::differs(const StopReport& report) const {
    return !last_ || nodes_json(last_->end.nodes) != nodes_json(report.nodes);
}

bool RunEnds::acknowledge(uint64_t number) {
    if (!last_ || last_->end.number != number) return false;
    acknowledged_ = true;
    return true;
}

size_t RunEnds::missing() const {
    if (!last_) return 0;
    const auto& nodes = last_->end.nodes;
    return static_cast<size_t>(std::count_if(nodes.begin(), nodes.end(), is_missing));
}

bool RunEnds::open() const {
    return missing() > 0 && !acknowledged_;
}

std::string RunEnds::kind() const {
    const bool failed = last_->end.result == "Error" || last_->end.cause.why == Why::Error;
    return failed || missing() > 0 ? "error" : "note";
}

std::string RunEnds::sentence() const {
    const life::End& end = last_->end;
    std::string text = who_stopped(end.cause);
    if (!end.result.empty()) text += fmt::format("; the plan's result: {}", end.result);
    if (!end.message.empty()) text += fmt::format(" ({})", end.message);
    text += who_rests(end.nodes);
    for (const StopNode& node : end.nodes) {
        if (!is_missing(node)) continue;
        text += fmt::format("; {}: {}", session::number_and_name(node), word_of(node.state));
    }
    return text;
}

Json RunEnds::document() const {
    Json document = {{"open", open()}};
    if (!last_) return document;
    const life::End& end = last_->end;
    Json told = {{"number", end.number},
                 {"t", last_->t},
                 {"wall", last_->wall_ms},
                 {"by", end.cause.by.substr(0, kByMax)},
                 {"why", life::name_of(end.cause.why)},
                 {"nodes", nodes_json(end.nodes)}};
    if (!end.result.empty()) told["result"] = end.result;
    if (!end.message.empty()) told["message"] = end.message.substr(0, kMessageMax);
    document["end"] = std::move(told);
    return document;
}

}  // namespace vagus::serve
