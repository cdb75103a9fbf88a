#include "record/causes.hpp"

#include <fmt/format.h>

#include "record/past_bus.hpp"
#include "session/plan_world.hpp"
#include "wire/bytes.hpp"
#include "wire/protocol.hpp"

namespace vagus::record {

namespace {

using Kind = Causes::Happening::Kind;

std::string describe(const sim::Act& act) {
    switch (act.kind) {
        case sim::Act::Kind::Press:
            return fmt::format("a person pressed the button \"{}\"", act.button);
        case sim::Act::Kind::Release:
            return fmt::format("a person released the button \"{}\"", act.button);
        case sim::Act::Kind::Tap:
            return "a person tapped the robot";
        case sim::Act::Kind::MoveRobot:
            return "a person moved the robot";
        case sim::Act::Kind::Move:
            return "a person moved an object";
        case sim::Act::Kind::Remove:
            return "a person took an object away";
        case sim::Act::Kind::Light:
            return fmt::format("a person switched a light {}", act.on ? "on" : "off");
        case sim::Act::Kind::Put:
            return fmt::format("a person put {} there",
                               act.put.id.empty() ? "an object" : "\"" + act.put.id + "\"");
    }
    return "a person did something";
}

// The button, or the id of the object that it is done to; a contact with it follows from that.
std::string with_of(const sim::Act& act, const sim::World& world) {
    if (act.kind == sim::Act::Kind::Put) return act.put.id;
    for (const sim::ObjectView& object : world.objects()) {
        if (act.object.number != 0 && object.id == act.object) return object.definition->id;
    }
    return act.button;
}

// What an entry of the timeline does, and to what.
struct Done {
    std::string what;
    std::string with;
    std::string robot;
};

Done describe(const sim::Action& action) {
    if (const auto* add = std::get_if<sim::AddObject>(&action)) {
        return {fmt::format("the timeline of the world put \"{}\" there", add->object.id),
                add->object.id, ""};
    }
    if (const auto* remove = std::get_if<sim::RemoveObject>(&action)) {
        return {fmt::format("the timeline of the world removed \"{}\"", remove->id), remove->id,
                ""};
    }
    if (const auto* move = std::get_if<sim::MoveObject>(&action)) {
        return {fmt::format("the timeline of the world moved \"{}\"", move->id), move->id,
                move->id};
    }
    if (const auto* press = std::get_if<sim::PressButton>(&action)) {
        return {fmt::format("the timeline of the world {} the button \"{}\" of {}",
                            press->pressed ? "pressed" : "released", press->button, press->robot),
                press->button, press->robot};
    }
    if (const auto* light = std::get_if<sim::SwitchLight>(&action)) {
        return {fmt::format("the timeline of the world switched \"{}\" {}", light->id,
                            light->on ? "on" : "off"),
                light->id, ""};
    }
    return {"the timeline of the world did something to its fleet", "", ""};
}

}  // namespace

Causes::Causes(Rerun& rerun) : rerun_(rerun) {
    rerun.listen([this](const plan::TraceEvent& event) { see(event); });
    rerun.pass_over([this](const run::Raising& raising) {
        raised_[lines_.size()] = raising.tied;  // its line is the next
        return false;
    });
    if (rerun.past_bus() != nullptr) learn(*rerun.past_bus());
    session::SimSession* const session = rerun.session();
    if (session == nullptr) return;
    sim::World& world = session->world();
    world.number_frames();
    world.watch(this);
    world.on_timeline([this, &world](size_t entry) {
        const Done done = describe(world.definition().timeline[entry].action);
        const auto robot = world.find_robot(done.robot);
        add({.at = world.definition().timeline[entry].at,
             .kind = Kind::Timeline,
             .robot = robot ? robot->number : 0,
             .what = done.what,
             .with = done.with,
             .entry = entry});
    });
    session->on_frame(
        [this](const wire::Frame& frame, uint32_t number) { frame_on_bus(frame, number); });
    rerun.each_instant([this](Time at) { look(at); });
    rerun.before_act([this, &world](const sim::Act& act) {
        add({.at = now(),
             .kind = Kind::Person,
             .robot = act.robot.number,
             .what = describe(act),
             .with = with_of(act, world)});
    });
    if (rerun.plan_world() == nullptr) return;
    rerun.plan_world()->on_emit([this](Time, const run::BusEvent& event) {
        emitted_.push_back({event.name, std::string(event.by), event.cause, lines_.size()});
    });
}

Causes::~Causes() {
    session::SimSession* const session = rerun_.session();
    if (session == nullptr) return;
    session->world().watch(nullptr);
    session->world().on_timeline({});
    if (rerun_.plan_world() != nullptr) rerun_.plan_world()->on_emit({});
}

void Causes::learn(const PastBus& past) {
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

Time Causes::now() const {
    return rerun_.session()->now();
}

// ---- the nodes ----

void Causes::begin_run(HandlerRun run) {
    run.at = now();
    OfNode& node = nodes_[key_of(run.node)];
    run.call = node.call;
    runs_.push_back(run);
    node.run = static_cast<uint32_t>(runs_.size());
}

void Causes::began_by_frame(const sim::WitnessedNode& node, uint16_t pc, uint32_t frame) {
    begin_run({.at = {}, .node = node, .pc = pc, .frame = frame});
}

// A touch is felt of what the robot met last; a button that somebody pressed.
void Causes::began_by_itself(const sim::WitnessedNode& node, uint16_t pc, uint8_t event) {
    HandlerRun run{.at = {}, .node = node, .pc = pc, .frame = 0, .event = event};
    const aesl::Target* const target = rerun_.session()->target(node.id);
    const std::string name = target != nullptr && event < target->local_events.size()
                                 ? target->local_events[event].name
                                 : "";
    if (name == "touch" || name == "tap") {
        run.happening = last_happening(node.robot, Kind::Contact, "");
        const uint32_t tapped = last_happening(node.robot, Kind::Person, "");
        const bool later = tapped > run.happening &&
                           happenings_[tapped - 1].what.find("tapped") != std::string::npos;
        if (name == "tap" && later) run.happening = tapped;
    } else if (name.starts_with("button")) {
        const size_t dot = name.find('.');
        const std::string button = dot == std::string::npos ? "" : name.substr(dot + 1);
        run.happening = std::max(last_happening(node.robot, Kind::Person, button),
                                 last_happening(node.robot, Kind::Timeline, button));
    }
    begin_run(run);
}

void Causes::wrote(const sim::WitnessedNode& node, uint16_t pc, uint16_t address, int16_t value) {
    OfNode& of = nodes_[key_of(node)];
    if (of.writes.size() <= address) of.writes.resize(size_t{address} + 1);
    of.writes[address] = {now(), of.run, pc, value, false};
}

void Causes::called(const sim::WitnessedNode& node, uint16_t pc, uint16_t native) {
    OfNode& of = nodes_[key_of(node)];
    calls_.push_back({{now(), of.run, pc, 0, false}, node, native});
    const aesl::Target* const target = rerun_.session()->target(node.id);
    if (target == nullptr || native >= target->natives.size()) return;
    // Arithmetic ends nothing later.
    if (!target->natives[native].name.starts_with("math.")) {
        of.call = static_cast<uint32_t>(calls_.size());
    }
}

void Causes::sends(const sim::WitnessedNode& node, uint16_t pc) {
    OfNode& of = nodes_[key_of(node)];
    of.sending.push_back({now(), of.run, pc, 0, false});
}

void Causes::sent(const sim::WitnessedNode& node, uint32_t frame) {
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

void Causes::frame_on_bus(const wire::Frame& frame, uint32_t number) {
    host_sets(frame);
    if (number == 0 || !wire::is_user_event(frame.type)) return;
    Frame& of = frames_[number];
    debug::UserEvent event = debug::user_event_of(frame, rerun_.session()->common());
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
void Causes::host_sets(const wire::Frame& frame) {
    if (frame.type != static_cast<uint16_t>(wire::MessageType::SetVariables)) return;
    wire::Reader reader(frame.payload, frame.size);
    const uint16_t id = reader.u16();
    size_t address = reader.u16();
    for (const session::NodeState& node : rerun_.session()->nodes()) {
        if (node.id != id) continue;
        std::vector<Deed>& writes = nodes_[key_of({node.robot.number, id})].writes;
        while (reader.left() >= 2) {
            if (writes.size() <= address) writes.resize(address + 1);
            writes[address++] = {now(), 0, 0, reader.i16(), true};
        }
    }
}

// ---- the world ----

void Causes::add(Happening happening) {
    happenings_.push_back(std::move(happening));
}

uint32_t Causes::last_happening(uint32_t robot, Happening::Kind kind, std::string_view with) const {
    for (size_t i = happenings_.size(); i-- > 0;) {
        const Happening& one = happenings_[i];
        if (one.kind != kind || (robot != 0 && one.robot != robot)) continue;
        if (with.empty() || one.with == with) return static_cast<uint32_t>(i + 1);
    }
    return 0;
}

void Causes::look(Time at) {
    const sim::World& world = rerun_.session()->world();
    for (const sim::Happening& one : world.happenings()) {
        const auto* const broke = std::get_if<sim::ChaosNote>(&one.what);
        if (broke != nullptr && broke->begins) {
            add({.at = at,
                 .kind = Kind::Chaos,
                 .robot = one.robot.number,
                 .what = "a fault of --chaos: " + broke->what,
                 .with = {},
                 .entry = broke->fault});
        }
        const auto* const contact = std::get_if<sim::Contact>(&one.what);
        if (contact == nullptr) continue;
        const std::string& robot = world.definition().robots[one.robot.number - 1].name;
        const std::string with = contact->with.empty() ? "something" : contact->with;
        Happening happening{.at = at,
                            .kind = Kind::Contact,
                            .robot = one.robot.number,
                            .what = fmt::format("{} touched \"{}\"", robot, with),
                            .with = contact->with};
        for (const Kind kind : {Kind::Timeline, Kind::Person}) {
            if (contact->with.empty()) continue;
            happening.before = std::max(happening.before, last_happening(0, kind, contact->with));
        }
        add(std::move(happening));
    }
}

// ---- the plan ----

void Causes::see(const plan::TraceEvent& event) {
    lines_.push_back({event, plan::format_trace(event)});
}

// ---- looking ----

const Causes::Frame* Causes::frame(uint32_t number) const {
    const auto found = frames_.find(number);
    return found == frames_.end() ? nullptr : &found->second;
}

const Causes::HandlerRun* Causes::run(uint32_t number) const {
    return number == 0 || number > runs_.size() ? nullptr : &runs_[number - 1];
}

const Causes::Call* Causes::call(uint32_t number) const {
    return number == 0 || number > calls_.size() ? nullptr : &calls_[number - 1];
}

uint32_t Causes::last_event(std::string_view name, uint32_t before) const {
    for (auto at = frames_.rbegin(); at != frames_.rend(); ++at) {
        if (at->first < before && at->second.event == name) return at->first;
    }
    return 0;
}

std::vector<std::string> Causes::events_seen() const {
    std::vector<std::string> names;
    for (const auto& [number, frame] : frames_) names.push_back(frame.event);
    return names;
}

std::optional<Causes::Deed> Causes::last_write(const sim::WitnessedNode& node, uint16_t address,
                                               uint16_t count) const {
    const auto found = nodes_.find(key_of(node));
    if (found == nodes_.end()) return std::nullopt;
    std::optional<Deed> last;
    for (size_t i = address; i < size_t{address} + count && i < found->second.writes.size(); ++i) {
        const Deed& deed = found->second.writes[i];
        if (deed.at != kNotYet && (!last || deed.at >= last->at)) last = deed;
    }
    return last;
}

uint32_t Causes::last_call(uint32_t robot, std::string_view prefix) const {
    for (size_t i = calls_.size(); i-- > 0;) {
        const Call& call = calls_[i];
        if (call.node.robot != robot) continue;
        const aesl::Target* const target = rerun_.session()->target(call.node.id);
        if (target == nullptr || call.native >= target->natives.size()) continue;
        if (target->natives[call.native].name.starts_with(prefix)) {
            return static_cast<uint32_t>(i + 1);
        }
    }
    return 0;
}

}  // namespace vagus::record
