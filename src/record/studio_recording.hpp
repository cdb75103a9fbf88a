// The recording of a run of the studio, in the process of that run: of a plan in its world, or of
// the world alone. It waits for nothing, and what it cannot record ends it, with a sentence.
//
//     auto recording = TRY(StudioRecording::begin(path, about, files, session, &prepared));
//     recording->begin_turn();                       // at each place at which something can come
//     recording->asked(request);                     // the debugger of the plan
//     recording->hold();                             // instead of hold_instant() of the world
//     const Status written = recording->end();       // while the session is there
//
// Acts on the world and frames on its bus are heard by themselves.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "embed/prepared_run.hpp"
#include "record/recording.hpp"

namespace vagus::record {

class StudioRecording final : public Recording {
public:
    // Paths in `about` and in `files`, which the run has read, are those of this computer. Session
    // and run are borrowed, until end(); no run: the world alone.
    static Result<std::unique_ptr<StudioRecording>> begin(
        const std::string& path, RunFile about, const std::map<std::string, std::string>& files,
        session::SimSession& session, embed::PreparedRun* run);
    ~StudioRecording() override;

    // What comes from here on comes at another place of the run than what came before.
    void begin_turn();
    // ---- what comes; acts and frames come by themselves ----
    void hold();
    void asked(const run::Request& request);
    void changed(const FilesSaved& files) override;
    void loaded(uint16_t node, const std::string& file, const std::string& text);
    // All that is random is drawn from this seed from here on.
    void reseeded(uint64_t seed) { recorder_->input(Reseeded{seed}); }

    // A world alone in which no time has passed leaves no file.
    Status end() override;

private:
    StudioRecording(std::string path, std::unique_ptr<FileTape> tape, std::string_view run,
                    PackedFiles files, session::SimSession& session);
    Time now() const override { return session_.now(); }
    void put(InputWhat what) override { recorder_->input(std::move(what)); }

    const std::string path_;
    session::SimSession& session_;
    bool of_plan_ = false;
};

}  // namespace vagus::record
