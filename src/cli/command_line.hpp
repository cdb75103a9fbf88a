// The map of the program: one verb for each thing that Vagus does. What a verb takes and how it
// runs is in the file of its name; the list is verbs.def.
#pragma once

namespace vagus::cli {

// Reads the command line, runs its verb, and returns the exit status: 0 done, 1 the work failed,
// 2 the command line or a file it names is wrong.
int run_command_line(int argc, const char* const* argv);

}  // namespace vagus::cli
