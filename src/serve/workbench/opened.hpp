// What a path that a person names opens: a folder with a vagus.json, a folder without one that
// holds scripts, plans or worlds, or an .aesl, a plan, a world alone.
//
//     const OpenedProject project = TRY(open_path("examples/follow-wall"));
//     files.enter(project.root, project.only);
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "fleet/project_part.hpp"
#include "session/safe_stop.hpp"

namespace vagus::serve {

struct OpenedProject {
    // The outermost folder of the project: what paths of documents count from.
    std::filesystem::path root;
    std::vector<std::string> only;  // files that are listed; empty: all
    std::string folder;             // the innermost one, or that of a file that is opened alone
    std::string file;               // what was opened, as it can be opened again
    std::string name, help;
    // From the root, with / between folders; empty: none.
    std::string plan, world, project_file;
    std::vector<std::string> scripts, toolboxes;
    std::string target = "sim";
    bool stops_alone = false;     // when the last page is closed
    session::SafeStop safe_stop;  // what its file says of nodes
    fleet::ProjectPart fleet;
    std::vector<std::pair<std::string, std::string>> start_set;
    std::string copy_of;    // an example
    std::string recording;  // what the project was made of: it is looked at first

    // A script, plan or world without the folder around it.
    bool is_alone() const { return file != folder; }
    // A path of the project as one of this computer.
    std::string real(const std::string& path) const { return (root / path).string(); }
    // The document of a file of this computer; the path itself if it is elsewhere.
    std::string doc_of(const std::string& file) const;
    nlohmann::json to_json() const;  // Project of the protocol
};

// What robots need, and a folder that the studio opens may lack.
Error no_project_file_in(const std::string& folder);

// The Error says what can be opened.
Result<OpenedProject> open_path(const std::string& path);

}  // namespace vagus::serve
