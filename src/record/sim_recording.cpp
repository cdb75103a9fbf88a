#include "record/sim_recording.hpp"

#include <fmt/format.h>

#include "base/seconds.hpp"

namespace vagus::record {

std::string end_input(Time at) {
    return fmt::format(R"({{"t":{},"do":"end"}})", seconds_text(at));
}

Result<std::unique_ptr<SimRecording>> SimRecording::begin(const std::string& path, RunFile about,
                                                          const FilesRead& files,
                                                          session::SimSession& session, Pace pace) {
    auto tape = TRY(start_tape(path, about, files, pace));
    // make_unique cannot reach the constructor.
    std::unique_ptr<SimRecording> made(
        new SimRecording(std::move(tape), format_run(about), session));
    made->recorder_->follow(session);
    return made;
}

Status SimRecording::end() {
    if (recorder_) {
        recorder_->input(session_.now(), end_input(session_.now()));
        recorder_->end(session_.now());
    }
    recorder_.reset();
    return tape_->end();
}

}  // namespace vagus::record
