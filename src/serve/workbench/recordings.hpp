// The recordings of the runs of a project, in a folder of its own: run-1.mcap, run-2.mcap … The
// newest are kept, as many as there is room for.
//
//     Recordings recordings;
//     recordings.enter(root / ".vagus" / "recordings");
//     const auto path = recordings.next(run_.time() > 0);   // for the run that begins
//     const std::string last = recordings.of_run(run_.time() > 0);
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace vagus::serve {

constexpr size_t kRecordingsKept = 10;                       // and the one that is being made
constexpr uint64_t kRecordingsBytesMax = uint64_t{1} << 30;  // of all of them, when a run begins

class Recordings {
public:
    // Another project; an empty path: none.
    void enter(std::filesystem::path folder);

    // The file of a run that begins; `had_begun`: time has passed in the one that it replaces.
    // Older ones are deleted, but never the one before, nor `needed`. The Error says why there can
    // be none.
    Result<std::string> next(bool had_begun, const std::string& needed = "");
    // The run has ended, and none takes its place yet; as next().
    void over(bool had_begun);
    // The one of the run that is there or, as long as no time has passed in it, of the run before.
    // Empty: there is none.
    std::string of_run(bool has_begun) const;

    struct Kept {
        std::string path;
        uint64_t number = 0;
        uint64_t bytes = 0;
        double when_wall = 0;  // ms since 1970: of the last that was written
    };
    // The newest first. Not the one that is being made.
    std::vector<Kept> kept() const;
    bool keeps(const std::string& path) const;

private:
    void make_room(const std::string& needed) const;

    std::filesystem::path folder_;
    std::string now_;
    std::string before_;
};

}  // namespace vagus::serve
