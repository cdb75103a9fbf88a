#include "cli/studio/runner.hpp"

#include <CLI/CLI.hpp>

#include "cli/output.hpp"
#include "serve/runner/runner.hpp"
#include "serve/runner/try_host.hpp"
#include "serve/runner/why_host.hpp"

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

void add_why_host(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("why-host", "a question about a run of the studio");
    verb->group("");
    verb->footer("Example:\n  vagus why-host 3<>socket");
    verb->callback(
        [&exit_code] { exit_code = serve::run_why(serve::Pipe(serve::kTalkDescriptor)); });
}

void add_try_host(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("try-host", "a plan that is tried in the studio");
    verb->group("");
    verb->footer("Example:\n  vagus try-host 3<>socket");
    verb->callback(
        [&exit_code] { exit_code = serve::run_try(serve::Pipe(serve::kTalkDescriptor)); });
}

}  // namespace vagus::cli
