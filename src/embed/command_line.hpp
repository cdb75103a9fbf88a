// `vagus plan run`'s options for a program that holds its plan (docs/plans.md, section 6).
//
//     int main(int argc, char** argv) { return vagus::embed::run_main(&make_Square, argc, argv); }
#pragma once

#include "embed/plan_code.hpp"
#include "run/code.hpp"
#include "toolbox/parts.hpp"

namespace vagus::embed {

// Runs the plan with the options of the command line and the built-in toolboxes; gives the exit
// status of section 6.
int run_main(MakePlan make, int argc, char** argv);
// The same with toolboxes of the program's own; `parts` are those that they borrow.
int run_main(MakePlan make, const run::CodeLibrary& library, toolbox::Parts& parts, int argc,
             char** argv);

}  // namespace vagus::embed
