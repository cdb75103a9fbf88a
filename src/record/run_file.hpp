// What a recording says of its run, and the files that the run read: what is needed to run it
// again, anywhere.
//
//     RunFile run;
//     run.verb = "plan run";
//     const PackedFiles files = pack(read.all());           // FilesRead (base/file.hpp)
//     run.plan = files.name_of("examples/follow-wall/WallFollow.plan.json");
//     …                                                     // each of files.files is attached
//     tape.put(about, Time{}, format_run(run));
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/temporary_folder.hpp"

namespace vagus::record {

constexpr std::string_view kStudioVerb = "studio";
constexpr std::string_view kTestVerb = "test";  // of a world without a plan
constexpr std::string_view kDebugVerb = "plan debug";
constexpr std::string_view kNetVerb = "net record";
constexpr std::string_view kBusKind = "bus";

// Paths are names of attachments.
struct RunFile {
    std::string kind = "simulated";         // or kBusKind
    std::string verb = {};                  // "plan run", "sim", or one of those above
    std::vector<std::string> command = {};  // as it was typed, for people
    std::string plan = {};
    std::string world = {};
    std::string bus = {};      // a target, for people
    std::string project = {};  // of a real bus: gives the names of its events
    std::vector<std::string> toolboxes = {};
    std::vector<std::string> set = {};
    std::string from = {};
    std::string seed = {};
    std::string max_time = {};
    std::string robot = {};
    std::string answers = {};
    std::string chaos = {};  // the list of faults as JSON, with those that were drawn; empty: none
    std::vector<std::string> poses = {};
    std::vector<std::string> loads = {};  // --load of sim, scripts of a test
    // Of a world whose robots have projects of their own: their names, in the order of the file.
    std::vector<std::string> robots = {};

    bool is_of_bus() const { return kind == kBusKind; }
};

// One line of JSON.
std::string format_run(const RunFile& run);
// The Error names what is wrong; `name` is the recording, for its sentence.
Result<RunFile> read_run(std::string_view text, const std::string& name);

// What is of one plan cannot be of a world whose robots have projects of their own. The Error says
// so, then `instead`: "; record one that …".
Status check_no_fleet(const RunFile& run, const std::string& name, std::string_view instead);

struct PackedFiles {
    std::string root;                          // the folder below which all of them are
    std::map<std::string, std::string> files;  // by name: the path from there

    // The name of a file, by a path as a person would type it.
    std::string name_of(const std::string& path) const;
};

// `read` by path, as it was read.
PackedFiles pack(const std::map<std::string, std::string>& read);

// Writes a file of a recording into a folder. Refuses a name that leads out of it.
Status write_inside(const std::string& folder, const std::string& name, std::string_view content);

// A folder for the files of a recording, which goes with its owner.
class UnpackedFolder {
public:
    static Result<UnpackedFolder> make();
    Status add(const std::string& name, std::string_view content) const {
        return write_inside(folder_.path(), name, content);
    }
    std::string path_of(const std::string& name) const;

private:
    explicit UnpackedFolder(TemporaryFolder folder) : folder_(std::move(folder)) {}
    TemporaryFolder folder_;
};

}  // namespace vagus::record
