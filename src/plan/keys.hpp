// The keys of each kind of object in a plan file, in the order of saving (docs/plans.md, P0).
// Reading and formatting both use this one list.
#pragma once

#include <span>
#include <string_view>

namespace vagus::plan {

using Keys = std::span<const std::string_view>;
inline constexpr std::string_view kPlanKeys[] = {
    "format", "name", "help", "toolboxes", "configuration", "start", "actors", "layout", "x"};
inline constexpr std::string_view kVariableKeys[] = {"type", "initial", "unit",
                                                     "help", "access",  "x"};
inline constexpr std::string_view kStartKeys[] = {"actor", "supervisors", "x"};
inline constexpr std::string_view kActorKeys[] = {"template", "plan",        "in",   "out",
                                                  "states",   "supervisors", "help", "x"};
inline constexpr std::string_view kSupervisorKeys[] = {"template", "period_ms", "in", "out",
                                                       "events",   "help",      "x"};

}  // namespace vagus::plan
