// The recording of a run of a plan, as `vagus plan run` prepares it, or the studio for a bus: from
// before its first instant to its end. One on a real bus (RunFile::is_of_bus()) is recorded with
// its frames.
//
//     FilesRead files;                                       // before anything is read
//     …                                                      // the run is prepared
//     auto recording = TRY(PlanRecording::begin("run.mcap", run, files.all(), *prepared, …));
//     const run::Ended ended = TRY(prepared->run());
//     const Status written = recording->end();
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "embed/prepared_run.hpp"
#include "record/plan_bus_tap.hpp"
#include "record/recording.hpp"
#include "run/debugger.hpp"

namespace vagus::record {

// Connects a recorder with a run that has not begun; what a person does to the run is an input.
// Gives the listener of the run that it is now.
int attach(Recorder& recorder, embed::PreparedRun& run);

class PlanRecording final : public Recording {
public:
    // Paths in `about` are as they were typed, and so are those of `files`, which the run has read.
    // The Error says why there can be no recording. `run` is borrowed, until end().
    static Result<std::unique_ptr<PlanRecording>> begin(
        const std::string& path, RunFile about, const std::map<std::string, std::string>& files,
        embed::PreparedRun& run, Pace pace);
    // Before the run, beside a world: what the cameras see is recorded, too (check_cameras()).
    void follow_cameras() { recorder_->follow_cameras(); }
    // Before the run: what is asked of its debugger is recorded; in virtual time the turn of such
    // an input is its place in the run (Debugger::Follower). Borrowed until let_go().
    void follow(run::Debugger& debugger);
    // On a real bus, before its debugger is asked to take that version.
    void changed(const FilesSaved& files) override;
    // After the run, while its world is there. The same run may be done once more: that is not
    // recorded.
    void let_go();
    // The same, and waits until all is written.
    Status end() override;

private:
    PlanRecording(std::unique_ptr<FileTape> tape, std::string_view run, PackedFiles files)
        : Recording(std::move(tape), run, std::move(files)) {}
    void asked(const run::Request& request, Time at);
    void takes(const run::TakeVersion& version, Time at);
    Time now() const override { return tap_ ? tap_->now() : last_; }
    void put(InputWhat what) override { recorder_->input_at(now(), std::move(what)); }

    std::unique_ptr<PlanBusTap> tap_;  // on a real bus
    embed::PreparedRun* run_ = nullptr;
    run::Debugger* debugger_ = nullptr;
    std::vector<int> listeners_;  // of the run
    Time last_{};                 // line of the trace
    std::mutex mutex_;            // guards what follows
    // Versions that the run has not come to yet.
    std::map<const plan::Graph*, PlanFiles> versions_;
};

}  // namespace vagus::record
