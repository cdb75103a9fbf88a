// The names in a project's own condition of being well (docs/fleet.md): whether its plan has these
// variables, and its nodes these words.
//
//     Checkup found = check_condition(files, scripts, "vagus.json");
//     for (const DocFinding& finding : found.findings) show(finding);
#pragma once

#include <string>

#include "serve/edit/file_checks.hpp"
#include "serve/script/scripts.hpp"

namespace vagus::serve {

// Nothing for a project without one, or whose file has mistakes. What scripts of a node declare and
// what is known of its description count; of a node that no script is for, nobody can tell.
Checkup check_condition(Files& files, Scripts& scripts, const std::string& project_file);

}  // namespace vagus::serve
