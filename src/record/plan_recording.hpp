// The recording of a run that `vagus plan run` prepares: from before its first instant to its end.
// One on a real bus (RunFile::is_of_bus()) is recorded with its frames.
//
//     FilesRead files;                                       // before anything is read
//     …                                                      // the run is prepared
//     auto recording = TRY(PlanRecording::begin("run.mcap", run, files, *prepared, Pace::Waits));
//     const run::Ended ended = TRY(prepared->run());
//     const Status written = recording->end();
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "embed/prepared_run.hpp"
#include "record/file_tape.hpp"
#include "record/plan_bus_tap.hpp"
#include "record/recorder.hpp"
#include "record/run_file.hpp"
#include "run/debugger.hpp"

namespace vagus::record {

// Connects a recorder with a run that has not begun; what a person does to the run is an input.
// Gives the listener of the run that it is now.
int attach(Recorder& recorder, embed::PreparedRun& run);

class PlanRecording {
public:
    // Paths in `run` are as they were typed. The Error says why there can be no recording. `run`
    // is borrowed, until end().
    static Result<std::unique_ptr<PlanRecording>> begin(const std::string& path, RunFile about,
                                                        const FilesRead& files,
                                                        embed::PreparedRun& run, Pace pace);
    // Before the run, beside a world: what the cameras see is recorded, too (check_cameras()).
    void follow_cameras() { recorder_->follow_cameras(); }
    // Before the run: what is asked of its debugger is recorded; in virtual time the turn of such
    // an input is its place in the run (Debugger::Follower). Borrowed until end().
    void follow(run::Debugger& debugger);
    // After the run, while its world is there. The first thing that went wrong. The same run may be
    // done once more: that is not recorded.
    Status end();
    // Messages that were dropped, for the disk was too slow.
    uint64_t dropped() const { return tape_->dropped(); }

private:
    PlanRecording(std::unique_ptr<FileTape> tape, std::string_view run)
        : tape_(std::move(tape)), recorder_(std::make_unique<Recorder>(*tape_, run)) {}
    void asked(const run::Request& request, Time at);

    std::unique_ptr<FileTape> tape_;
    std::unique_ptr<Recorder> recorder_;
    std::unique_ptr<PlanBusTap> tap_;  // on a real bus
    embed::PreparedRun* run_ = nullptr;
    run::Debugger* debugger_ = nullptr;
    PackedFiles files_;           // their names; not what is in them
    std::vector<int> listeners_;  // of the run
    Time last_{};                 // line of the trace
};

}  // namespace vagus::record
