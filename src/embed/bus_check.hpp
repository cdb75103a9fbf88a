// Whether the events that a plan names are those of its bus.
#pragma once

#include <string_view>

#include "base/result.hpp"
#include "embed/loaded_plan.hpp"
#include "plan/finding.hpp"
#include "session/bus_names.hpp"

namespace vagus::embed {

// Findings like those of the plan's own check.
plan::Findings missing_names(const session::BusNames& names, const LoadedPlan& plan);
// The same as an Error of several lines; `whose` plan it is begins them.
Status check_names(const session::BusNames& names, const LoadedPlan& plan,
                   std::string_view whose = "the");

}  // namespace vagus::embed
