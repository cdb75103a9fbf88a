// A verb of the command line: how it is called and what runs it. To add one: a line in verbs.def, a
// file in CMakeLists.txt, and in that file
//
//     void vagus::cli::add_exec(CLI::App& app, int& exit_code) {
//         CLI::App* verb = app.add_subcommand("exec", "compiles a script and runs it");
//         verb->footer("Example:\n  vagus exec blink.aesl --node node.json");
//         // Owners: the options of CLI11 that fill it, and the callback.
//         auto options = std::make_shared<Options>();
//         verb->add_option("FILE", options->file, "the script")->required();
//         verb->callback([options, &exit_code] { exit_code = exec(*options); });
//     }
//
// Every verb has an example in its footer (a test looks). Exit codes: 0 done, 1 the work failed, 2
// the command line or a file it names is wrong. Words for people go to stderr, results to stdout
// (output.hpp).
#pragma once

namespace CLI {
class App;
}

namespace vagus::cli {

#define VERB(name) void add_##name(CLI::App& app, int& exit_code);
#include "cli/verbs.def"
#undef VERB

}  // namespace vagus::cli
