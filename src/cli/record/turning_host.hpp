// The verb `turning-host`, which --help does not show: one search for a turning point, for the
// studio, whose server starts it. It is asked through a socket (serve/workbench/turning_talk.hpp),
// tells there how far it is, and ends with its answer. When it is killed, so are the processes of
// its continuations.
#pragma once

namespace CLI {
class App;
}

namespace vagus::cli {

void add_turning_host(CLI::App& app, int& exit_code);

}  // namespace vagus::cli
