// A folder without a vagus.json: what of it runs, and how it gets one.
//
//     const FolderFiles files = files_of_folder(folder);
//     const std::string plan = only_one(files.plans);   // empty: none, or one of several
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace vagus::serve {

struct OpenedProject;

// Names of files in the folder itself, in the order of their names.
struct FolderFiles {
    std::vector<std::string> plans, worlds, scripts, toolboxes;
    bool any() const { return !plans.empty() || !worlds.empty() || !scripts.empty(); }
};
FolderFiles files_of_folder(const std::filesystem::path& folder);

std::string only_one(const std::vector<std::string>& names);
// The one that is called as `file` is: hall.world.json for hall.plan.json; else the only one.
std::string one_beside(const std::string& file, const std::vector<std::string>& names);

// Writes the vagus.json that the folder of what is open lacks, and the world and the scripts that a
// run lacks. Nothing that is there is changed. Gives the folder to open: where the file is in a
// project already, that one, and nothing is written. `shown`: the path of the document that a
// person looks at in a folder of several; it is what runs. `examples`: where scripts come from.
Result<std::string> make_project_of(const OpenedProject& opened, const std::string& shown,
                                    const std::filesystem::path& examples);

}  // namespace vagus::serve
