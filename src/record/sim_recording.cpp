#include "record/sim_recording.hpp"

#include <filesystem>

#include "base/project_border.hpp"
#include "sim/chaos_file.hpp"

namespace vagus::record {

namespace {

namespace fs = std::filesystem;

// And the file of the project around all of it, which nobody had to read: up to there files of the
// robots' projects may name others.
Result<PackedFiles> pack_with_border(const FilesRead& read, const RunFile& about) {
    std::map<std::string, std::string> files = read.all();
    const std::string border = about.robots.empty() ? "" : project_border(about.world);
    if (!border.empty()) {
        // By the way that the world was named, which may be a link.
        const fs::path typed = fs::path(about.world).parent_path();
        const fs::path up = fs::path(border).lexically_relative(fs::weakly_canonical(typed / "."));
        const std::string file = (typed / up / kProjectFileName).lexically_normal().string();
        files.try_emplace(file, TRY(read_file(file)));
    }
    return pack(files);
}

}  // namespace

Result<std::unique_ptr<SimRecording>> SimRecording::begin(const std::string& path, RunFile about,
                                                          const FilesRead& files,
                                                          embed::RobotsRun& run, Pace pace) {
    about.robots = TRY(recorded_robots(run));
    const auto& faults = run.buses().world().chaos();
    if (!faults.empty()) about.chaos = sim::format_chaos(faults);
    const PackedFiles packed = TRY(pack_with_border(files, about));
    auto tape = TRY(start_tape(path, about, packed, pace));
    // make_unique cannot reach the constructor.
    return std::unique_ptr<SimRecording>(new SimRecording(std::move(tape), format_run(about), run));
}

SimRecording::SimRecording(std::unique_ptr<FileTape> tape, std::string_view about,
                           embed::RobotsRun& run)
    : tape_(std::move(tape)),
      recorder_(std::make_unique<Recorder>(*tape_, about)),
      session_(run.buses().common()) {
    recorder_->follow(session_);
    robots_ = std::make_unique<RobotRecorders>(*tape_, run);
}

Status SimRecording::end() {
    if (recorder_) {
        recorder_->input(RecordingEnds{});
        recorder_->end(session_.now());
        robots_->end(session_.now());
    }
    robots_.reset();
    recorder_.reset();
    return tape_->end();
}

}  // namespace vagus::record
