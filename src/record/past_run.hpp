// What a recording says of its run, read for one that lives it again: as a whole (replay.hpp), or
// up to an instant from which a run of the studio goes on in its own way.
//
//     const PastRun past = TRY(read_past("run-3.mcap", until));
//     const auto paths = TRY(past.paths("/home/ann/hall/hall.world.json"));
//     for (const auto& [name, content] : past.files) then.put(paths.of(name), content);
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "mcap/reader.hpp"
#include "record/inputs.hpp"
#include "record/run_file.hpp"

namespace vagus::record {

// When the last thing of it was recorded.
Time end_of(const mcap::Reader& reader);

// All that is needed to run it again but its files, found in one pass.
struct RecordedRun {
    RunFile about;
    std::vector<Input> inputs;
    Time end{};  // as end_of()
};
// The Error names the recording, and what in it cannot be read.
Result<RecordedRun> read_recorded(const mcap::Reader& reader);

// Where files of a recording lie on this computer.
class PastPaths {
public:
    PastPaths(std::filesystem::path folder, std::filesystem::path name)
        : folder_(std::move(folder)), name_(std::move(name)) {}
    std::string of(const std::string& name) const;

private:
    std::filesystem::path folder_, name_;  // the same one, here and in the recording
};

// If the file at that path may be the one that the recording calls `name`: so are those beside it.
std::optional<PastPaths> paths_beside(const std::string& name, const std::string& path);

struct PastRun {
    RunFile about;
    std::map<std::string, std::string> files;  // as they were when the run began, by name
    std::vector<Input> inputs;                 // what came before the run and before `until`
    Time until{};

    // If this is the path of its plan or, without one, of its world.
    Result<PastPaths> paths(const std::string& main) const;
    // Its plan or, without one, its world, by name.
    const std::string& main() const { return about.plan.empty() ? about.world : about.plan; }
};

// Up to an instant or, without one, to its end. The Error says why it cannot be lived up to then:
// to a run of another verb than kStudioVerb nothing may have come from outside.
Result<PastRun> read_past(const std::string& path, std::optional<Time> until);

}  // namespace vagus::record
