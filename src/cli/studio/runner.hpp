// The verbs `run-host`, `why-host`, `log-host`, `compare-host`, `keep-host` and `try-host`, which
// --help does not show: a run, questions about one or two, one that becomes a test, and a plan that
// is tried, as processes of their own, started by the studio's server.
#pragma once

namespace CLI {
class App;
}

namespace vagus::cli {

void add_runner(CLI::App& app, int& exit_code);
void add_why_host(CLI::App& app, int& exit_code);
void add_log_host(CLI::App& app, int& exit_code);
void add_compare_host(CLI::App& app, int& exit_code);
void add_keep_host(CLI::App& app, int& exit_code);
void add_try_host(CLI::App& app, int& exit_code);

}  // namespace vagus::cli
