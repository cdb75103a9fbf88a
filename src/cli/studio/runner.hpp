// The verb `run-host`, which --help does not show: a run as a process of its own, started by the
// studio's server.
#pragma once

namespace CLI {
class App;
}

namespace vagus::cli {

void add_runner(CLI::App& app, int& exit_code);

}  // namespace vagus::cli
