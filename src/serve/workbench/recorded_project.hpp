// The project of a recording from anywhere: the files that its run read, as they were, and the
// recording beside them. There it is looked at, asked and continued as a run of one's own.
//
//     const RecordedProject made = TRY(project_of_recording("/home/ann/run.mcap", projects));
//     const OpenedProject project = TRY(open_path(made.folder));
#pragma once

#include <filesystem>
#include <string>

#include "base/result.hpp"

namespace vagus::serve {

constexpr size_t kCopiesMax = 1000;  // folders of one name

// "run", "run-2", "run-3": the first that is free is taken.
std::string numbered(const std::string& name, size_t number);

// Both files are there, with the same in them.
bool same_bytes(const std::filesystem::path& one, const std::filesystem::path& other);

struct RecordedProject {
    std::string folder;     // of its own, below `projects`
    std::string recording;  // a file in it
};

// The one that was made of the same recording before, or a new one. The Error says why there is
// none; nothing of it is left then. Takes as long as reading and copying the recording.
Result<RecordedProject> project_of_recording(const std::filesystem::path& recording,
                                             const std::filesystem::path& projects);

}  // namespace vagus::serve
