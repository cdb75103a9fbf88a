#include "record/sim_recording.hpp"

#include "sim/chaos_file.hpp"

namespace vagus::record {

Result<std::unique_ptr<SimRecording>> SimRecording::begin(const std::string& path, RunFile about,
                                                          const FilesRead& files,
                                                          session::SimSession& session, Pace pace) {
    const auto& faults = session.world().chaos();
    if (!faults.empty()) about.chaos = sim::format_chaos(faults);
    auto tape = TRY(start_tape(path, about, pack(files.all()), pace));
    // make_unique cannot reach the constructor.
    std::unique_ptr<SimRecording> made(
        new SimRecording(std::move(tape), format_run(about), session));
    made->recorder_->follow(session);
    return made;
}

Status SimRecording::end() {
    if (recorder_) {
        recorder_->input(RecordingEnds{});
        recorder_->end(session_.now());
    }
    recorder_.reset();
    return tape_->end();
}

}  // namespace vagus::record
