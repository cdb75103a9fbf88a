// What is derived from the description of the command line, so that it cannot drift apart from it:
// the completion of the shell (completions/vagus.bash) and the page docs/cli.md. `vagus page
// bash|man|manual` prints them, `./test` compares.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace vagus::cli {

// The help of the app itself: App::help() gives that of the verb which was typed.
std::string own_help(CLI::App& app);
std::string bash_completion(CLI::App& app);
std::string manual_page(CLI::App& app);

// The verb `page`, which --help does not show.
void add_page(CLI::App& app, int& exit_code);

// Makes help texts of the whole program: long lines broken, columns aligned.
void shape_help(CLI::App& app);

}  // namespace vagus::cli
