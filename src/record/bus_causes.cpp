#include "record/bus_causes.hpp"

#include <algorithm>
#include <iterator>

#include "debug/user_event.hpp"
#include "record/past_bus.hpp"
#include "wire/bytes.hpp"
#include "wire/protocol.hpp"

namespace vagus::record {

using Kind = Happening::Kind;

BusCauses::BusCauses(const RunBus& bus, const Happenings& happenings)
    : bus_(bus), happenings_(happenings) {
    if (bus.session == nullptr) return;
    bus.session->world().number_frames();
    bus.session->on_frame(
        [this](const wire::Frame& frame, uint32_t number) { frame_on_bus(frame, number); });
}

void BusCauses::learn(const PastBus& past) {
    for (const auto& [number, one] : past.events()) {
        const RecordedEvent& event = one.event;
        Frame& frame = frames_[number];
        frame.at = event.at;
        frame.event = event.name;
        frame.arguments = event.arguments;
        frame.source = event.node;
        frame.of_bus = event.node != wire::kHostId;
        frame.by = event.by;
        frame.line = one.lines;
        frame.cause = one.cause;
    }
}

Time BusCauses::now() const {
    return bus_.session->now();
}

// ---- the nodes ----

void BusCauses::begin_run(HandlerRun run) {
    run.at = now();
    OfNode& node = nodes_[key_of(run.node)];
    run.call = node.call;
    runs_.push_back(run);
    node.run = static_cast<uint32_t>(runs_.size());
}

void BusCauses::began_by_frame(const sim::WitnessedNode& node, uint16_t pc, uint32_t frame) {
    begin_run({.at = {}, .node = node, .pc = pc, .frame = frame});
}

// A touch is felt of what the robot met last; a button that somebody pressed.
void BusCauses::began_by_itself(const sim::WitnessedNode& node, uint16_t pc, uint8_t event) {
    HandlerRun run{.at = {}, .node = node, .pc = pc, .frame = 0, .event = event};
    const aesl::Target* const target = bus_.session->target(node.id);
    const std::string name = target != nullptr && event < target->local_events.size()
                                 ? target->local_events[event].name
                                 : "";
    if (name == "touch" || name == "tap") {
        run.happening = happenings_.last(node.robot, Kind::Contact, "");
        const uint32_t tapped = happenings_.last(node.robot, Kind::Person, "");
        const bool later = tapped > run.happening &&
                           happenings_.find(tapped)->what.find("tapped") != std::string::npos;
        if (name == "tap" && later) run.happening = tapped;
    } else if (name.starts_with("button")) {
        const size_t dot = name.find('.');
        const std::string button = dot == std::string::npos ? "" : name.substr(dot + 1);
        run.happening = std::max(happenings_.last(node.robot, Kind::Person, button),
                                 happenings_.last(node.robot, Kind::Timeline, button));
    }
    begin_run(run);
}

void BusCauses::wrote(const sim::WitnessedNode& node, uint16_t pc, uint16_t address,
                      int16_t value) {
    OfNode& of = nodes_[key_of(node)];
    if (of.writes.size() <= address) of.writes.resize(size_t{address} + 1);
    of.writes[address] = {now(), of.run, pc, value, false};
}

void BusCauses::called(const sim::WitnessedNode& node, uint16_t pc, uint16_t native) {
    OfNode& of = nodes_[key_of(node)];
    calls_.push_back({{now(), of.run, pc, 0, false}, node, native});
    const aesl::Target* const target = bus_.session->target(node.id);
    if (target == nullptr || native >= target->natives.size()) return;
    // Arithmetic ends nothing later.
    if (!target->natives[native].name.starts_with("math.")) {
        of.call = static_cast<uint32_t>(calls_.size());
    }
}

void BusCauses::sends(const sim::WitnessedNode& node, uint16_t pc) {
    OfNode& of = nodes_[key_of(node)];
    of.sending.push_back({now(), of.run, pc, 0, false});
}

void BusCauses::sent(const sim::WitnessedNode& node, uint32_t frame) {
    Frame& of = frames_[frame];
    of.at = now();
    of.node = node;
    of.source = node.id;
    std::deque<Deed>& sending = nodes_[key_of(node)].sending;
    if (sending.empty()) return;  // it was sent before anybody looked
    of.deed = sending.front();
    sending.pop_front();
}

// ---- the bus ----

void BusCauses::frame_on_bus(const wire::Frame& frame, uint32_t number) {
    host_sets(frame);
    if (number == 0 || !wire::is_user_event(frame.type)) return;
    Frame& of = frames_[number];
    debug::UserEvent event = debug::user_event_of(frame, bus_.session->common());
    of.event = debug::name_or_number(event);
    of.arguments = std::move(event.arguments);
    of.source = frame.source;
    if (of.node.robot != 0) return;
    of.at = now();
    while (!emitted_.empty()) {
        const Emission emission = std::move(emitted_.front());
        emitted_.pop_front();
        if (emission.event != of.event) continue;  // one that was refused
        of.by = emission.by;
        of.cause = emission.cause;
        of.line = emission.line;
        return;
    }
}

// A node's words, set by a host.
void BusCauses::host_sets(const wire::Frame& frame) {
    if (frame.type != static_cast<uint16_t>(wire::MessageType::SetVariables)) return;
    wire::Reader reader(frame.payload, frame.size);
    const uint16_t id = reader.u16();
    size_t address = reader.u16();
    for (const session::NodeState& node : bus_.session->nodes()) {
        if (node.id != id) continue;
        std::vector<Deed>& writes = nodes_[key_of({node.robot.number, id})].writes;
        while (reader.left() >= 2) {
            if (writes.size() <= address) writes.resize(address + 1);
            writes[address++] = {now(), 0, 0, reader.i16(), true};
        }
    }
}

// ---- the plan and the fleet ----

void BusCauses::line(const plan::TraceEvent& event) {
    lines_.push_back({event, plan::format_trace(event)});
}

void BusCauses::raising(const run::Raising& raising) {
    raised_[lines_.size()] = raising.tied;  // its line is the next
}

void BusCauses::plan_sent(const run::BusEvent& event) {
    emitted_.push_back({event.name, std::string(event.by), event.cause, lines_.size()});
}

void BusCauses::fleet_brought(const embed::FleetEvent& event) {
    const uint32_t frame = bus_.session->world().frame_numbers()->cause_of(event.number);
    messages_[event.number] = {now(), event, frame};
    emitted_.push_back({event.name, "", event.number, lines_.size()});
}

// ---- looking ----

const BusCauses::Frame* BusCauses::frame(uint32_t number) const {
    const auto found = frames_.find(number);
    return found == frames_.end() ? nullptr : &found->second;
}

const BusCauses::HandlerRun* BusCauses::run(uint32_t number) const {
    return number == 0 || number > runs_.size() ? nullptr : &runs_[number - 1];
}

const BusCauses::Message* BusCauses::message(uint32_t number) const {
    const auto found = messages_.find(number);
    return found == messages_.end() ? nullptr : &found->second;
}

const BusCauses::News* BusCauses::news(uint32_t number) const {
    const auto found = news_.find(number);
    return found == news_.end() ? nullptr : &found->second;
}

std::optional<Time> BusCauses::heard_at(uint32_t number) const {
    if (const Frame* const one = frame(number)) return one->at;
    if (const Message* const one = message(number)) return one->at;
    if (const News* const one = news(number)) return one->at;
    return std::nullopt;
}

const BusCauses::Asked* BusCauses::asked(uint64_t question) const {
    const auto found = asked_.find(question);
    return found == asked_.end() ? nullptr : &found->second;
}

const BusCauses::Call* BusCauses::call(uint32_t number) const {
    return number == 0 || number > calls_.size() ? nullptr : &calls_[number - 1];
}

uint32_t BusCauses::last_event(std::string_view name) const {
    for (auto at = frames_.rbegin(); at != frames_.rend(); ++at) {
        if (at->second.event == name) return at->first;
    }
    return 0;
}

uint32_t BusCauses::last_event_heard(std::string_view name, uint32_t before) const {
    const auto end = frames_.lower_bound(before);
    const uint16_t hearer = frame(before) != nullptr ? frame(before)->source : wire::kHostId;
    for (auto at = std::make_reverse_iterator(end); at != frames_.rend(); ++at) {
        if (at->second.event == name && at->second.source != hearer) return at->first;
    }
    return 0;
}

std::vector<std::string> BusCauses::events_seen() const {
    std::vector<std::string> names;
    for (const auto& [number, frame] : frames_) {
        if (!frame.event.empty()) names.push_back(frame.event);
    }
    return names;
}

std::optional<BusCauses::Deed> BusCauses::last_write(const sim::WitnessedNode& node,
                                                     uint16_t address, uint16_t count) const {
    const auto found = nodes_.find(key_of(node));
    if (found == nodes_.end()) return std::nullopt;
    std::optional<Deed> last;
    for (size_t i = address; i < size_t{address} + count && i < found->second.writes.size(); ++i) {
        const Deed& deed = found->second.writes[i];
        if (deed.at != kNotYet && (!last || deed.at >= last->at)) last = deed;
    }
    return last;
}

uint32_t BusCauses::last_call(uint32_t robot, std::string_view prefix) const {
    for (size_t i = calls_.size(); i-- > 0;) {
        const Call& call = calls_[i];
        if (call.node.robot != robot) continue;
        const aesl::Target* const target = bus_.session->target(call.node.id);
        if (target == nullptr || call.native >= target->natives.size()) continue;
        if (target->natives[call.native].name.starts_with(prefix)) {
            return static_cast<uint32_t>(i + 1);
        }
    }
    return 0;
}

}  // namespace vagus::record
