// Templates that a plan can never use, because a toolbox that it lists before has their names.
#pragma once

#include <vector>

#include "plan/finding.hpp"
#include "plan/model.hpp"
#include "plan/template.hpp"

namespace vagus::toolbox {

// A warning for each toolbox of a plan's list that has such templates, at its line; not where both
// toolboxes are built in.
plan::Findings find_shadowed(const std::vector<plan::Plan>& plans, const plan::Library& library);

}  // namespace vagus::toolbox
