// What a recording says of its run, read for one that lives it again: as a whole (replay.hpp), or
// up to an instant from which a run of the studio goes on in its own way.
//
//     const PastRun past = TRY(read_past("run-3.mcap", until));
//     const std::string folder = TRY(past.folder(world));      // of the files, on this computer
//     for (const auto& [name, content] : past.files) then.put(folder + name, content);
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "mcap/reader.hpp"
#include "record/inputs.hpp"
#include "record/run_file.hpp"

namespace vagus::record {

// The Error names the recording, and what in it cannot be read.
Result<RunFile> run_of(const mcap::Reader& reader);
Result<std::vector<Input>> inputs_of(const mcap::Reader& reader);
// When the last thing of it was recorded.
Time end_of(const mcap::Reader& reader);

struct PastRun {
    RunFile about;
    std::map<std::string, std::string> files;  // as they were when the run began, by name
    std::vector<Input> inputs;                 // what came before the run and before `until`
    Time until{};

    // The folder that names of files count from, with its slash, if this path of the plan or the
    // world is that of the recorded run.
    Result<std::string> folder(const std::string& path) const;
};

// Of a run of the studio. The Error says why it cannot be lived up to then.
Result<PastRun> read_past(const std::string& path, Time until);

}  // namespace vagus::record
