// The recording of `vagus sim`: from before the first instant of its world to the end.
//
//     FilesRead files;                                   // before anything is read
//     …                                                  // the world is opened
//     auto recording = TRY(SimRecording::begin("run.mcap", about, files, run, pace));
//     TRY(run.start());
//     …                                                  // time passes
//     const Status written = recording->end();
#pragma once

#include <memory>
#include <string>

#include "base/file.hpp"
#include "record/file_tape.hpp"
#include "record/recorder.hpp"
#include "record/robot_recorders.hpp"
#include "record/run_file.hpp"

namespace vagus::record {

class SimRecording {
public:
    // Paths in `about` are as they were typed. The run is borrowed, until end(). The Error says why
    // it is not recorded.
    static Result<std::unique_ptr<SimRecording>> begin(const std::string& path, RunFile about,
                                                       const FilesRead& files,
                                                       embed::RobotsRun& run, Pace pace);
    // As PlanRecording::follow_cameras().
    void follow_cameras() { recorder_->follow_cameras(); }
    // The first thing that went wrong.
    Status end();
    uint64_t dropped() const { return tape_->dropped(); }

private:
    SimRecording(std::unique_ptr<FileTape> tape, std::string_view about, embed::RobotsRun& run);

    std::unique_ptr<FileTape> tape_;
    std::unique_ptr<Recorder> recorder_;
    std::unique_ptr<RobotRecorders> robots_;
    session::SimSession& session_;  // of the common bus
};

}  // namespace vagus::record
