#include "serve/runner/run_recording.hpp"

#include <fmt/format.h>

namespace vagus::serve {

std::map<std::string, std::string> RunRecording::Files::take() {
    if (!read_) return {};
    std::map<std::string, std::string> all = read_->all();
    read_.reset();
    return all;
}

void RunRecording::begin(const talk::Open& order, Files& read, session::SimSession& session,
                         embed::PreparedRun* run) {
    if (order.recording.empty()) return;
    record::RunFile about;
    about.plan = order.plan;
    about.world = order.world;
    about.toolboxes = order.toolboxes;
    about.robot = order.robot;
    about.from = order.from;
    about.seed = order.seed;
    about.poses = order.starts;
    about.chaos = order.chaos;
    if (run != nullptr) about.max_time = kPlanMaxTime;
    for (const auto& [name, value] : order.set) about.set.push_back(name + "=" + value);
    std::map<std::string, std::string> files = read.take();
    if (order.world_text) files[order.world] = *order.world_text;
    auto begun = record::StudioRecording::begin(order.recording, about, files, session, run);
    if (!begun.ok()) {
        return teller_.line(talk::LineKind::Warning,
                            "this run is not recorded: " + begun.error().what);
    }
    recording_ = std::move(begun.value());
}

void RunRecording::end() {
    if (!recording_) return;
    const Status ended = recording_->end();
    tell();
    if (!ended.ok()) teller_.line(talk::LineKind::Warning, ended.error().what);
    if (recording_->dropped() > 0) {
        teller_.line(talk::LineKind::Warning,
                     fmt::format("the disk was too slow for the recording of this run: {} samples "
                                 "of variables and poses were left out",
                                 recording_->dropped()));
    }
    answer_flushes(true);
    recording_.reset();
}

void RunRecording::begin_turn() {
    if (recording_) recording_->begin_turn();
}

void RunRecording::hold(sim::World& world) {
    recording_ ? recording_->hold() : world.hold_instant();
}

void RunRecording::asked(const run::Request& request) {
    if (recording_) recording_->asked(request);
}

void RunRecording::changed(const std::vector<std::string>& saved,
                           const std::map<std::string, std::string>& read) {
    if (recording_) recording_->changed(saved, read);
}

void RunRecording::loaded(uint16_t node, const std::string& file, const std::string& text) {
    if (recording_) recording_->loaded(node, file, text);
}

void RunRecording::reseeded(uint64_t seed) {
    if (recording_) recording_->reseeded(seed);
}

void RunRecording::flush(uint64_t request) {
    if (recording_) {
        flushes_.emplace_back(request, recording_->flush());
        return;
    }
    teller_.answer(request, Status::done());
}

void RunRecording::tell() {
    if (!recording_) return;
    if (const auto trouble = recording_->take_trouble()) {
        teller_.line(talk::LineKind::Warning, *trouble);
    }
    answer_flushes(false);
}

void RunRecording::answer_flushes(bool all) {
    std::erase_if(flushes_, [&](const auto& one) {
        if (!all && !recording_->flushed(one.second)) return false;
        teller_.answer(one.first, Status::done());
        return true;
    });
}

}  // namespace vagus::serve
