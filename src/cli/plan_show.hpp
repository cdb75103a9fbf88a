// `vagus plan run --world`, for people: on a terminal the live plan beside its world; else plain
// lines of what happens.
//
//     12.340 s  checkLane: LaneNotFree → findWallAngle
#pragma once

#include "cli/plan_run.hpp"

namespace vagus::cli {

// Where a run beside a world is shown, by its options and by what stdin and stdout are.
enum class PlanShown { Nowhere, Lines, Screen };
PlanShown how_to_show(const PlanRunOptions& options);

// To the end of the plan; gives the exit code.
int run_on_screen(PlanRun& run);
int run_in_lines(PlanRun& run);

}  // namespace vagus::cli
