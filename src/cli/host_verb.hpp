// A verb that --help does not show: a process that the studio's server starts, and that it talks to
// through a socket.
//
//     add_host_verb(app, {"why-host", "a question about a run of the studio"}, serve::run_why,
//                   exit_code);
#pragma once

#include <functional>
#include <string>

#include "serve/process.hpp"

namespace CLI {
class App;
}

namespace vagus::cli {

struct HostVerb {
    std::string name;
    std::string about;
};

// `run` gives the exit code.
void add_host_verb(CLI::App& app, const HostVerb& host, std::function<int(serve::Pipe)> run,
                   int& exit_code);

}  // namespace vagus::cli
