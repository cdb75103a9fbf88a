// The paths of other files that a file names: vagus.json its plan, scripts, world and toolboxes, a
// plan its sub-plans, a world its robots' scripts and projects and its picture, a toolbox its
// project, a test its plan, world and toolboxes.
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
    bool folder = false;
};

// Whether files of its kind name others.
bool may_name_others(const std::string& file);

// Nothing for files of other kinds, and for texts that are no JSON.
std::vector<NamedPath> named_paths(const std::string& file, std::string_view text);

}  // namespace vagus::serve
