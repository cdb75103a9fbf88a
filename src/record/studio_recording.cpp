#include "record/studio_recording.hpp"

#include <filesystem>
#include <utility>

#include "record/plan_recording.hpp"

namespace vagus::record {

Result<std::unique_ptr<StudioRecording>> StudioRecording::begin(
    const std::string& path, RunFile about, const std::map<std::string, std::string>& files,
    session::SimSession& session, embed::PreparedRun* run) {
    PackedFiles packed = pack(files);
    about.verb = kStudioVerb;
    auto tape = TRY(start_tape(path, about, packed, Pace::NeverWaits));
    // make_unique cannot reach the constructor.
    std::unique_ptr<StudioRecording> made(
        new StudioRecording(path, std::move(tape), format_run(about), std::move(packed), session));
    made->of_plan_ = run != nullptr;
    if (run == nullptr) {
        made->recorder_->follow(session);
        return made;
    }
    attach(*made->recorder_, *run);
    return made;
}

StudioRecording::StudioRecording(std::string path, std::unique_ptr<FileTape> tape,
                                 std::string_view run, PackedFiles files,
                                 session::SimSession& session)
    : Recording(std::move(tape), run, std::move(files)),
      path_(std::move(path)),
      session_(session) {}

StudioRecording::~StudioRecording() {
    (void)end().ok();
}

void StudioRecording::begin_turn() {
    recorder_->begin_turn();
    tend();
}

void StudioRecording::hold() {
    recorder_->hold();
}

void StudioRecording::asked(const run::Request& request) {
    if (!does_something(request)) return;
    run::Request named = request;
    if (auto* const stop = std::get_if<run::AddBreakpoint>(&named)) {
        std::string& plan = stop->breakpoint.plan;
        if (!plan.empty()) plan = files_.name_of(plan);
    }
    recorder_->input(std::move(named));
}

void StudioRecording::changed(const FilesSaved& files) {
    auto named_files = named(files);
    if (!named_files.ok()) return stop(named_files.error().what);
    recorder_->input(std::move(named_files.value()));
}

// Without its file only the names of variables and lines are missing.
void StudioRecording::loaded(uint16_t node, const std::string& file, const std::string& text) {
    const std::string name = name_in_it(file);
    if (!name.empty()) recorder_->script({node, name, text}, file);
}

Status StudioRecording::end() {
    if (!recorder_) return Status::done();
    const bool empty = !of_plan_ && session_.now() == Time{};
    if (!is_stopped()) {
        recorder_->begin_turn();
        recorder_->input(RecordingEnds{});
        recorder_->end(session_.now());
    }
    recorder_.reset();
    const Status written = tape_->end();
    std::error_code ignored;
    if (empty) std::filesystem::remove(path_, ignored);
    return is_stopped() ? Status::done() : written;
}

}  // namespace vagus::record
