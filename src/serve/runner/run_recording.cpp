#include "serve/runner/run_recording.hpp"

#include <fmt/format.h>

namespace vagus::serve {

std::map<std::string, std::string> RunRecording::Files::take() {
    if (!read_) return {};
    std::map<std::string, std::string> all = read_->all();
    read_.reset();
    return all;
}

namespace {

record::RunFile about_run(const talk::Open& order) {
    record::RunFile about;
    about.plan = order.plan;
    about.world = order.world;
    about.toolboxes = order.toolboxes;
    about.robot = order.robot;
    about.from = order.from;
    about.seed = order.seed;
    about.poses = order.starts;
    about.chaos = order.chaos;
    about.loads = order.scripts;
    if (!order.plan.empty()) about.max_time = kPlanMaxTime;
    for (const auto& [name, value] : order.set) about.set.push_back(name + "=" + value);
    return about;
}

}  // namespace

void RunRecording::begin(const talk::Open& order, Files& read, session::SimSession& session,
                         embed::PreparedRun* run) {
    if (order.recording.empty()) return;
    std::map<std::string, std::string> files = read.take();
    if (order.world_text) files[order.world] = *order.world_text;
    auto begun =
        record::StudioRecording::begin(order.recording, about_run(order), files, session, run);
    if (!begun.ok()) return tended_.cannot(begun.error().what);
    in_world_ = begun.value().get();
    keep(std::move(begun.value()));
}

void RunRecording::begin_on_bus(const talk::Open& order, Files& read, embed::PreparedRun& run,
                                run::Debugger& debugger) {
    if (order.recording.empty()) return;
    record::RunFile about = about_run(order);
    about.kind = record::kBusKind;
    about.verb = record::kStudioVerb;
    about.bus = order.target;
    about.project = order.project;
    auto begun = record::PlanRecording::begin(order.recording, about, read.take(), run,
                                              record::Pace::NeverWaits);
    if (!begun.ok()) return tended_.cannot(begun.error().what);
    on_bus_ = begun.value().get();
    on_bus_->follow(debugger);
    keep(std::move(begun.value()));
}

void RunRecording::keep(std::unique_ptr<record::Recording> recording) {
    recording_ = recording.get();
    tended_.keep(std::move(recording), "variables and poses");
}

void RunRecording::let_go() {
    if (on_bus_) on_bus_->let_go();
}

void RunRecording::end() {
    tended_.end();
    recording_ = nullptr;
    in_world_ = nullptr;
    on_bus_ = nullptr;
}

void RunRecording::begin_turn() {
    if (in_world_) in_world_->begin_turn();
}

void RunRecording::hold(sim::World& world) {
    in_world_ ? in_world_->hold() : world.hold_instant();
}

void RunRecording::asked(const run::Request& request) {
    if (in_world_) in_world_->asked(request);
}

void RunRecording::changed(const record::FilesSaved& files) {
    if (recording_) recording_->changed(files);
}

void RunRecording::loaded(uint16_t node, const std::string& file, const std::string& text) {
    if (in_world_) in_world_->loaded(node, file, text);
}

void RunRecording::reseeded(uint64_t seed) {
    if (in_world_) in_world_->reseeded(seed);
}

void RunRecording::flush(uint64_t request) {
    tended_.flush([this, request] { teller_.answer(request, Status::done()); });
}

}  // namespace vagus::serve
