#include "cli/host_verb.hpp"

#include <CLI/CLI.hpp>
#include <utility>

namespace vagus::cli {

void add_host_verb(CLI::App& app, const HostVerb& host, std::function<int(serve::Pipe)> run,
                   int& exit_code) {
    CLI::App* verb = app.add_subcommand(host.name, host.about);
    verb->group("");
    verb->footer("Example:\n  vagus " + host.name + " 3<>socket");
    verb->callback([run = std::move(run), &exit_code] {
        exit_code = run(serve::Pipe(serve::kTalkDescriptor));
    });
}

}  // namespace vagus::cli
