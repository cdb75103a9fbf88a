#include "cli/studio/runner.hpp"

#include "cli/host_verb.hpp"
#include "cli/output.hpp"
#include "serve/runner/compare_host.hpp"
#include "serve/runner/keep_host.hpp"
#include "serve/runner/log_host.hpp"
#include "serve/runner/runner.hpp"
#include "serve/runner/try_host.hpp"
#include "serve/runner/why_host.hpp"

namespace vagus::cli {

void add_runner(CLI::App& app, int& exit_code) {
    const auto run = [](serve::Pipe pipe) {
        const serve::RunnerEnd end = serve::run_runner(std::move(pipe));
        return end.why.empty() ? end.status : complain(end.why, end.status);
    };
    add_host_verb(app, {"run-host", "a run of the studio"}, run, exit_code);
}

void add_why_host(CLI::App& app, int& exit_code) {
    add_host_verb(app, {"why-host", "a question about a run of the studio"}, serve::run_why,
                  exit_code);
}

void add_log_host(CLI::App& app, int& exit_code) {
    add_host_verb(app, {"log-host", "log points put into a run of the studio"}, serve::run_log,
                  exit_code);
}

void add_compare_host(CLI::App& app, int& exit_code) {
    add_host_verb(app, {"compare-host", "two runs that are compared in the studio"},
                  serve::run_compare, exit_code);
}

void add_keep_host(CLI::App& app, int& exit_code) {
    add_host_verb(app, {"keep-host", "a run of the studio that becomes a test"}, serve::run_keep,
                  exit_code);
}

void add_try_host(CLI::App& app, int& exit_code) {
    add_host_verb(app, {"try-host", "a plan that is tried in the studio"}, serve::run_try,
                  exit_code);
}

}  // namespace vagus::cli
