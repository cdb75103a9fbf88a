// The recording of a run of the studio, in the process of that run: of a plan in its world, or of
// the world alone. It waits for nothing, and what it cannot record ends it, with a sentence.
//
//     auto recording = TRY(StudioRecording::begin(path, about, files, session, &prepared));
//     recording->begin_turn();                       // at each place at which something can come
//     recording->asked(request);                     // the debugger of the plan
//     recording->hold();                             // instead of hold_instant() of the world
//     if (const auto why = recording->take_trouble()) show(*why);
//     const Status written = recording->end();       // while the session is there
//
// Acts on the world and frames on its bus are heard by themselves.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "embed/prepared_run.hpp"
#include "record/file_tape.hpp"
#include "record/recorder.hpp"
#include "record/run_file.hpp"

namespace vagus::record {

constexpr uint64_t kStudioRecordingBytesMax = uint64_t{512} << 20;  // then it ends, and says so

class StudioRecording {
public:
    // Paths in `about` and in `files`, which the run has read, are those of this computer. Session
    // and run are borrowed, until end(); no run: the world alone.
    static Result<std::unique_ptr<StudioRecording>> begin(
        const std::string& path, RunFile about, const std::map<std::string, std::string>& files,
        session::SimSession& session, embed::PreparedRun* run,
        uint64_t bytes_max = kStudioRecordingBytesMax);
    ~StudioRecording();

    // What comes from here on comes at another place of the run than what came before.
    void begin_turn();
    // ---- what comes; acts and frames come by themselves ----
    void hold();
    void asked(const run::Request& request);
    // Plan files were saved, and these were read for the version that is made of them.
    void changed(const std::vector<std::string>& saved,
                 const std::map<std::string, std::string>& read);
    void loaded(uint16_t node, const std::string& file, const std::string& text);
    // All that is random is drawn from this seed from here on.
    void reseeded(uint64_t seed) { recorder_->input(Reseeded{seed}); }

    // All that is there now is to be in the file; flushed() tells when it is.
    uint64_t flush() { return tape_->flush(); }
    bool flushed(uint64_t number) const { return tape_->flushed(number); }
    // Why it has ended before the run, once.
    std::optional<std::string> take_trouble() { return std::exchange(trouble_, std::nullopt); }
    // A world alone in which no time has passed leaves no file. The first thing that went wrong.
    Status end();
    uint64_t dropped() const { return tape_->dropped(); }

private:
    StudioRecording(std::string path, std::unique_ptr<FileTape> tape, std::string_view run,
                    PackedFiles files, session::SimSession& session, uint64_t bytes_max);
    void stop(const std::string& why);
    // Empty: it is not below the folder of the recording.
    std::string name_in_it(const std::string& path) const;

    const std::string path_;
    const uint64_t bytes_max_;
    PackedFiles files_;  // their names; not what is in them
    session::SimSession& session_;
    std::unique_ptr<FileTape> tape_;
    std::unique_ptr<Recorder> recorder_;
    std::optional<std::string> trouble_;
    bool of_plan_ = false;
    bool stopped_ = false;
};

}  // namespace vagus::record
