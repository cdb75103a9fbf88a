// The paths of other files that a file names: vagus.json its plan, scripts, world and toolboxes, a
// plan its sub-plans, a world its robots' scripts and its picture, a toolbox its project.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "aesl/diagnostic.hpp"
#include "serve/edit/json_patch.hpp"

namespace vagus::serve {

struct NamedPath {
    std::vector<JsonStep::Key> at;  // the way to it
    std::string text;               // as it is there
    aesl::Position place;
};

// Nothing for files of other kinds, and for texts that are no JSON.
std::vector<NamedPath> named_paths(const std::string& file, std::string_view text);

}  // namespace vagus::serve
