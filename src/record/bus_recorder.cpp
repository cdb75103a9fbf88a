#include "record/bus_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "aesl/node_file.hpp"
#include "base/json.hpp"
#include "base/seconds.hpp"
#include "debug/names.hpp"
#include "debug/user_event.hpp"
#include "record/topics.hpp"
#include "wire/bytes.hpp"
#include "wire/protocol.hpp"

namespace vagus::record {

BusRecorder::BusRecorder(FileTape& tape) : tape_(tape) {
    frames_ = tape_.declare({.name = std::string(kFramesTopic), .json = false});
    events_ = tape_.declare({.name = std::string(kEventsTopic)});
    described_ = tape_.declare({.name = std::string(kNodesTopic)});
}

// Of two nodes with one name each has its id in the names.
void BusRecorder::described(Time at, const debug::NodeView& node) {
    if (nodes_.size() >= kNodesRecordedMax && !nodes_.contains(node.id)) return;
    const auto same_name = [&](const auto& one) {
        return one.first != node.id && one.second.name == node.name;
    };
    const bool shared = std::ranges::any_of(nodes_, same_name);
    const std::string label =
        shared ? node.name + "-" + std::to_string(node.id) : std::string(node.name);
    Node& known = nodes_[node.id];
    known = {.name = node.name, .topic = topics_[label]};
    if (known.topic == 0) {
        known.topic = topics_[label] =
            tape_.declare({.name = "/node/" + label + "/variables", .may_be_dropped = true});
    }
    for (const aesl::VariablePlace& one : debug::variables_of(node)) {
        known.variables.emplace_back(one.name, one.address, one.size);
    }
    known.words.resize(node.target->variables_size);
    known.known.resize(known.words.size());
    const std::string file = std::string(kNodesFolder) + label + ".json";
    tape_.put(described_, at,
              fmt::format(R"({{"t":{},"node":{},"name":{},"file":{}}})", seconds_text(at), node.id,
                          json_quote(node.name), json_quote(file)));
    if (!attached_.insert(file).second) return;
    tape_.attach_later(file, aesl::format_node_file({*node.target, common_}));
}

void BusRecorder::happened(Time at, const debug::Event& event) {
    const bool left = std::holds_alternative<debug::NodeDisconnected>(event.what);
    const auto found = nodes_.find(event.node);
    if (found == nodes_.end()) return;
    if (!left && !std::holds_alternative<debug::NodeReconnected>(event.what)) return;
    tape_.put(described_, at,
              fmt::format(R"({{"t":{},"node":{},"name":{},"state":"{}"}})", seconds_text(at),
                          event.node, json_quote(found->second.name), left ? "left" : "there"));
}

uint32_t BusRecorder::frame(Time at, const Passed& passed) {
    const wire::Frame& frame = passed.frame;
    const uint32_t number = ++last_;
    tape_.put(frames_, at, format_frame(text_, {number, passed.cause, frame}));
    if (wire::is_user_event(frame.type)) {
        RecordedEvent event =
            recorded_event(at, number, frame.source, debug::user_event_of(frame, common_));
        event.by = passed.by;
        tape_.put(events_, at, format_event(text_, event));
    } else if (frame.type == static_cast<uint16_t>(wire::MessageType::Variables)) {
        variables(at, frame);
    }
    return number;
}

// Told are variables of which all words are known, and that are new or others than before.
void BusRecorder::variables(Time at, const wire::Frame& frame) {
    const auto found = nodes_.find(frame.source);
    if (found == nodes_.end()) return;
    Node& node = found->second;
    wire::Reader reader(frame.payload, frame.size);
    const size_t begin = reader.u16();
    const std::vector<int16_t> before = node.words;
    const std::vector<bool> was_known = node.known;
    size_t end = begin;
    for (; reader.left() >= 2 && end < node.words.size(); ++end) {
        node.words[end] = reader.i16();
        node.known[end] = true;
    }
    const auto is_known = [](const RecordedVariable& one, const std::vector<bool>& known) {
        if (one.size == 0 || size_t{one.address} + one.size > known.size()) return false;
        const auto first = known.begin() + one.address;
        return std::all_of(first, first + one.size, [](bool is) { return is; });
    };
    std::vector<const RecordedVariable*> told;
    std::vector<const RecordedVariable*> changed;
    for (const RecordedVariable& one : node.variables) {
        if (!WordRange{begin, end}.touches(one) || !is_known(one, node.known)) continue;
        if (!is_known(one, was_known)) {
            told.push_back(&one);
        } else if (has_changed(one, before, node.words)) {
            changed.push_back(&one);
        }
    }
    told.insert(told.end(), changed.begin(), changed.end());
    if (told.empty()) return;
    const bool all = told.size() == node.variables.size();
    tape_.put(node.topic, at, format_variables(text_, {told, node.words, all, at}));
}

}  // namespace vagus::record
