// Paths that files name. A folder that holds a vagus.json is a project (docs/formats.md, "Project
// file"), and no path in its files leads out of it, also not through symbolic links: a project from
// a stranger reads nothing but itself. Where projects are in each other, the outermost is the
// border. Without a vagus.json there is none.
#pragma once

#include <string>

#include "base/result.hpp"

namespace vagus {

constexpr const char* kProjectFileName = "vagus.json";

// The outermost folder of those around `file` that holds a vagus.json, without links; empty if none
// does. `file` need not exist.
std::string project_border(const std::string& file);
// The innermost one, as a path like that of `file`: the project that is opened.
std::string innermost_project(const std::string& file);

// Whether a file that is in a project with that border (empty: none) may use `path`. The Error
// (Refused) names both.
Status check_inside(const std::string& border, const std::string& path);

// The path `named` in `file`, seen from the folder of that file; Refused if it leads out of the
// project.
Result<std::string> path_beside(const std::string& file, const std::string& named);

}  // namespace vagus
