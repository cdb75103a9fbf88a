// A recording that is being made of a run: what those in a world (studio_recording.hpp) and those
// of a plan (plan_recording.hpp) have in common, for who tells a person of it.
//
//     recording.keep_at_most(kStudioRecordingBytesMax);
//     recording.tend();                                      // now and then
//     if (const auto why = recording.take_trouble()) show(*why);
//     const uint64_t number = recording.flush();             // until flushed(number)
//     const Status written = recording.end();
//
// The run waits for none of it, and goes on where the recording cannot.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plan/graph.hpp"
#include "record/file_tape.hpp"
#include "record/recorder.hpp"
#include "record/run_file.hpp"

namespace vagus::record {

// Plan files that were saved, all that was read for the version that is made of them, by path, and
// that version; nullptr: it has mistakes.
struct FilesSaved {
    std::vector<std::string> saved = {};
    std::map<std::string, std::string> read = {};
    const plan::Graph* version = nullptr;
};

class Recording {
public:
    virtual ~Recording() = default;
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    // One that has more bytes than that ends.
    void keep_at_most(uint64_t bytes) { bytes_max_ = bytes; }
    // Ends one that cannot go on: it is too large, or cannot be written.
    void tend();
    // Why it has ended before the run, once.
    std::optional<std::string> take_trouble() { return std::exchange(trouble_, std::nullopt); }

    // The plan may get a new version.
    virtual void changed(const FilesSaved& files) = 0;

    // All that is there now is to be in the file; flushed() tells when it is.
    uint64_t flush() { return tape_->flush(); }
    bool flushed(uint64_t number) const { return tape_->flushed(number); }
    // The first thing that went wrong and was not told by take_trouble().
    virtual Status end() = 0;
    // Messages that were left out, for the disk was too slow.
    uint64_t dropped() const { return tape_->dropped(); }

protected:
    // `run` is the message of /vagus/run.
    Recording(std::unique_ptr<FileTape> tape, std::string_view run, PackedFiles files);

    // What was recorded stays: it can be run again up to here.
    void stop(const std::string& why);
    bool is_stopped() const { return stopped_; }
    // By the clock of the run.
    virtual Time now() const = 0;
    virtual void put(InputWhat what) = 0;
    // The files by the names that they have in the recording. The Error names one that it cannot
    // have.
    Result<PlanFiles> named(const FilesSaved& files) const;
    // Empty: it is not below the folder of the recording.
    std::string name_in_it(const std::string& path) const;

    std::unique_ptr<FileTape> tape_;
    std::unique_ptr<Recorder> recorder_;
    PackedFiles files_;  // their names; not what is in them

private:
    uint64_t bytes_max_ = UINT64_MAX;
    std::optional<std::string> trouble_;
    bool stopped_ = false;
};

}  // namespace vagus::record
