// The toolboxes of a command: the built-in ones and those of `--toolbox`.
#pragma once

#include <string>
#include <vector>

#include "base/result.hpp"
#include "run/code.hpp"
#include "toolbox/parts.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::session {

// Adds them all; the Error is that of the first file that is wrong. The parts are borrowed as long
// as the program runs.
Status add_toolboxes(run::CodeLibrary& library, const toolbox::Parts& parts,
                     const std::vector<std::string>& files);

// The events that the project at this path declares.
Result<toolbox::ProjectEvents> read_project_events(const std::string& path);

}  // namespace vagus::session
