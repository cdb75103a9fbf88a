// The file vagus.json that makes a folder a project (docs/formats.md, "Project file"): what is
// opened, and what is started, when the folder is named.
//
//     Result<ProjectFile> project = open_project("examples/follow-wall");
//     if (project.ok()) run(project.value().path_of(project.value().plan));
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "base/result.hpp"
#include "fleet/project_part.hpp"
#include "toolbox/safe_stop.hpp"

namespace vagus::session {

constexpr size_t kProjectBytesMax = 1u << 20;
constexpr size_t kProjectPathsMax = 256;      // scripts; the same for toolboxes
constexpr size_t kProjectVariablesMax = 256;  // of start.set
constexpr size_t kProjectPathBytesMax = 4096;

struct ProjectFile {
    std::string file;  // its path, as it was opened
    std::string name;
    std::string help;
    // Paths as they are in the file, from its folder; empty: none.
    std::string plan;
    std::vector<std::string> scripts;
    std::string world;
    std::vector<std::string> toolboxes;
    std::string target = "sim";  // "sim" (the world), or a target of docs/formats.md
    bool start_plan = false;
    // Variables of the plan and their values as `--set` takes them, in the order of the file.
    std::vector<std::pair<std::string, std::string>> start_set;
    toolbox::SafeStop safe_stop;  // its own entries only: session/safe_stop.hpp adds the others
    bool stops_alone = false;     // "when_alone": "stop": the robot stops when no page is open
    fleet::ProjectPart fleet;     // what it sends to other robots, and hears of them

    // A path of the file, seen from where the program runs.
    std::string path_of(const std::string& named) const;
};

// Text in, values out, or the Error that is first in the file. Paths are not looked at.
Result<ProjectFile> read_project_file(std::string_view text, const std::string& file);

// Everything that keeps the text from being read, in the order of the file: the first is the Error
// of read_project_file(). Empty: it can be read.
std::vector<Error> mistakes_of_project(std::string_view text, const std::string& file);

// Reads the project of a folder (or of the path of a vagus.json) and checks that each file that it
// names exists within the border (base/project_border.hpp).
Result<ProjectFile> open_project(const std::string& folder_or_file);

}  // namespace vagus::session
