// What a person has written, or a robot has done, is replaced by no output of another kind.
#pragma once

#include <string>

namespace vagus::cli {

// Whether that file is there, and is a script, a plan, a world, a toolbox, a project, a test or a
// recording by its name.
bool is_source_or_recording(const std::string& path);

}  // namespace vagus::cli
