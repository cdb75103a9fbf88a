// `vagus plan debug`: a run with a prompt (docs/plans-debug.md).
#pragma once

#include "cli/plan/run.hpp"

namespace vagus::cli {

int debug_plan(const PlanRunOptions& options);

}  // namespace vagus::cli
