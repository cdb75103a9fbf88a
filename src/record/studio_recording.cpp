#include "record/studio_recording.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "base/seconds.hpp"
#include "record/plan_recording.hpp"

namespace vagus::record {

Result<std::unique_ptr<StudioRecording>> StudioRecording::begin(
    const std::string& path, RunFile about, const std::map<std::string, std::string>& files,
    session::SimSession& session, embed::PreparedRun* run, uint64_t bytes_max) {
    PackedFiles packed = pack(files);
    about.verb = kStudioVerb;
    auto tape = TRY(start_tape(path, about, packed, Pace::NeverWaits));
    // make_unique cannot reach the constructor.
    std::unique_ptr<StudioRecording> made(new StudioRecording(
        path, std::move(tape), format_run(about), std::move(packed), session, bytes_max));
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
                                 session::SimSession& session, uint64_t bytes_max)
    : path_(std::move(path)),
      bytes_max_(bytes_max),
      files_(std::move(files)),
      session_(session),
      tape_(std::move(tape)),
      recorder_(std::make_unique<Recorder>(*tape_, run)) {
    files_.files.clear();
}

StudioRecording::~StudioRecording() {
    (void)end().ok();
}

// What was recorded stays: it can be run again up to here.
void StudioRecording::stop(const std::string& why) {
    if (std::exchange(stopped_, true)) return;
    recorder_->input(RecordingEnds{why});
    const Status written = tape_->end();
    trouble_ = fmt::format("the recording of this run ends at {} s: {}",
                           seconds_text(session_.now()), written.ok() ? why : written.error().what);
}

void StudioRecording::begin_turn() {
    recorder_->begin_turn();
    if (stopped_) return;
    const Status state = tape_->state();
    if (!state.ok()) return stop(state.error().what);
    if (tape_->bytes() <= bytes_max_) return;
    stop(fmt::format("it has {} MB, and more are not kept of one run", bytes_max_ >> 20));
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

std::string StudioRecording::name_in_it(const std::string& path) const {
    const std::string name = files_.name_of(path);
    return name.starts_with("..") ? "" : name;
}

void StudioRecording::changed(const std::vector<std::string>& saved,
                              const std::map<std::string, std::string>& read) {
    PlanFiles files;
    for (const std::string& path : saved) files.saved.push_back(name_in_it(path));
    for (const auto& [path, text] : read) {
        const std::string name = name_in_it(path);
        if (name.empty()) {
            return stop(path + " is outside of the folder of this recording; begin the run again");
        }
        files.texts[name] = text;
    }
    recorder_->input(std::move(files));
}

// Without its file only the names of variables and lines are missing.
void StudioRecording::loaded(uint16_t node, const std::string& file, const std::string& text) {
    const std::string name = name_in_it(file);
    if (!name.empty()) recorder_->script({node, name, text}, file);
}

Status StudioRecording::end() {
    if (!recorder_) return Status::done();
    const bool empty = !of_plan_ && session_.now() == Time{};
    if (!stopped_) {
        recorder_->begin_turn();
        recorder_->input(RecordingEnds{});
        recorder_->end(session_.now());
    }
    recorder_.reset();
    const Status written = tape_->end();
    std::error_code ignored;
    if (empty) std::filesystem::remove(path_, ignored);
    return stopped_ ? Status::done() : written;
}

}  // namespace vagus::record
