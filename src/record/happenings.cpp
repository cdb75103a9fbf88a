#include "record/happenings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vagus::record {

namespace {

using Kind = Happening::Kind;

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
    if (const auto* cut = std::get_if<sim::CutFleet>(&action)) {
        const std::string whom = cut->robot.empty() ? "all robots" : cut->robot;
        return {fmt::format("the timeline of the world {} the way of {} to the fleet",
                            cut->cut ? "cut" : "restored", whom),
                "", cut->robot};
    }
    const auto* const keeper = std::get_if<sim::RunKeeper>(&action);
    return {fmt::format("the timeline of the world {} the keeper of the fleet",
                        keeper != nullptr && keeper->on ? "started" : "killed"),
            "", ""};
}

}  // namespace

Happenings::Happenings(Rerun& rerun) : rerun_(rerun) {
    session::SimSession* const session = rerun.session();
    if (session == nullptr) return;
    sim::World& world = session->world();
    world.on_timeline([this](size_t entry) { entry_of_timeline(entry); });
    rerun.each_instant([this](Time at) { look(at); });
    rerun.before_act([this, &world](const sim::Act& act) {
        all_.push_back({.at = now(),
                        .kind = Kind::Person,
                        .robot = act.robot.number,
                        .what = describe(act),
                        .with = with_of(act, world)});
    });
}

Happenings::~Happenings() {
    if (rerun_.session() != nullptr) rerun_.session()->world().on_timeline({});
}

Time Happenings::now() const {
    return rerun_.session()->now();
}

void Happenings::entry_of_timeline(size_t entry) {
    const sim::World& world = rerun_.session()->world();
    const Done done = describe(world.definition().timeline[entry].action);
    const auto robot = world.find_robot(done.robot);
    all_.push_back({.at = world.definition().timeline[entry].at,
                    .kind = Kind::Timeline,
                    .robot = robot ? robot->number : 0,
                    .what = done.what,
                    .with = done.with,
                    .entry = entry});
}

uint32_t Happenings::last(uint32_t robot, Kind kind, std::string_view with) const {
    for (size_t i = all_.size(); i-- > 0;) {
        const Happening& one = all_[i];
        if (one.kind != kind || (robot != 0 && one.robot != robot)) continue;
        if (with.empty() || one.with == with) return static_cast<uint32_t>(i + 1);
    }
    return 0;
}

void Happenings::look(Time at) {
    for (const sim::Happening& one : rerun_.session()->world().happenings()) {
        const auto* const broke = std::get_if<sim::ChaosNote>(&one.what);
        if (broke != nullptr && broke->begins) {
            all_.push_back({.at = at,
                            .kind = Kind::Chaos,
                            .robot = one.robot.number,
                            .what = "a fault of --chaos: " + broke->what,
                            .with = {},
                            .entry = broke->fault});
        }
        const auto* const contact = std::get_if<sim::Contact>(&one.what);
        if (contact != nullptr) look_at_contact(one.robot.number, contact->with, at);
    }
}

void Happenings::look_at_contact(uint32_t robot, const std::string& with, Time at) {
    const std::string& name = rerun_.session()->world().definition().robots[robot - 1].name;
    Happening happening{
        .at = at,
        .kind = Kind::Contact,
        .robot = robot,
        .what = fmt::format("{} touched \"{}\"", name, with.empty() ? "something" : with),
        .with = with};
    for (const Kind kind : {Kind::Timeline, Kind::Person}) {
        if (!with.empty()) happening.before = std::max(happening.before, last(0, kind, with));
    }
    all_.push_back(std::move(happening));
}

// ---- a fleet that is gone ----

// The entry that cut it off, since its way was restored last.
uint32_t Happenings::cut_of(uint32_t robot) const {
    const auto& definition = rerun_.session()->world().definition();
    uint32_t first = 0;
    for (uint32_t number = 1; number <= all_.size(); ++number) {
        const Happening& one = all_[number - 1];
        if (one.kind != Kind::Timeline || (one.robot != 0 && one.robot != robot)) continue;
        const auto* const cut = std::get_if<sim::CutFleet>(&definition.timeline[one.entry].action);
        if (cut == nullptr) continue;
        if (!cut->cut) first = 0;
        if (cut->cut && first == 0) first = number;
    }
    return first;
}

void Happenings::stops_alone(uint32_t robot, const std::string& why) {
    const std::string& name = rerun_.session()->world().definition().robots[robot - 1].name;
    all_.push_back({.at = now(),
                    .kind = Kind::Alone,
                    .robot = robot,
                    .what = fmt::format("{} stopped by itself: {}", name, why),
                    .with = {},
                    .entry = 0,
                    .before = cut_of(robot)});
}

}  // namespace vagus::record
