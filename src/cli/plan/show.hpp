// `vagus plan run`, for people: beside a world on a terminal the live plan and the world; else
// plain lines of what happens.
//
//     12.340 s  checkLane: LaneNotFree → findWallAngle
#pragma once

#include "cli/plan/run.hpp"

namespace vagus::cli {

// Where a run is shown, by its options and by what stdin and stdout are. Where stdout carries a
// trace, the lines go to stderr.
enum class PlanShown { Nowhere, Lines, LinesOnStderr, Screen };
PlanShown how_to_show(const PlanRunOptions& options);

// To the end of the plan; gives the exit code.
int run_on_screen(TerminalRun& run, const std::string& theme);
int run_in_lines(TerminalRun& run, PlanShown shown);

}  // namespace vagus::cli
