// The safe stop of the nodes of a robot (docs/formats.md, "Safe stop"): what ships with the
// program, under what the toolbox files of a project say, under what the project itself says.
//
//     const SafeStop safe = TRY(safe_stop_of(toolbox_files, project.safe_stop));
//     const auto node = safe.find("thymio-II");
#pragma once

#include <string>
#include <vector>

#include "base/result.hpp"
#include "toolbox/safe_stop.hpp"

namespace vagus::session {

using toolbox::SafeStop;
using toolbox::SafeStopNode;

// Thymio II, e-puck, and what the built-in toolboxes say.
const SafeStop& shipped_safe_stop();

// `toolboxes`: paths of toolbox files, the later ones above the earlier; shared libraries among
// them say nothing. The Error is that of the first file that is wrong.
Result<SafeStop> safe_stop_of(const std::vector<std::string>& toolboxes, const SafeStop& project);

// For a file that is in a project, or in none: with what the innermost vagus.json around it and
// its toolboxes say; `toolboxes` override these, the project overrides all.
Result<SafeStop> safe_stop_around(const std::string& file,
                                  const std::vector<std::string>& toolboxes);

}  // namespace vagus::session
