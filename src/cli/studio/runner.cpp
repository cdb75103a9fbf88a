#include "cli/studio/runner.hpp"

#include <CLI/CLI.hpp>

#include "cli/output.hpp"
#include "serve/runner/runner.hpp"

namespace vagus::cli {

void add_runner(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("run-host", "a run of the studio");
    verb->group("");
    verb->footer("Example:\n  vagus run-host 3<>socket");
    verb->callback([&exit_code] {
        const serve::RunnerEnd end = serve::run_runner(serve::Pipe(serve::kTalkDescriptor));
        exit_code = end.why.empty() ? end.status : complain(end.why, end.status);
    });
}

}  // namespace vagus::cli
