// vagus serve: a project on a robot, run and served without anybody watching.
#include <CLI/CLI.hpp>
#include <cstdlib>

#include "base/log_lines.hpp"
#include "base/text.hpp"
#include "cli/fleet/broker_options.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/studio/door_options.hpp"
#include "cli/verbs.hpp"
#include "serve/field/service.hpp"

namespace vagus::cli {
namespace {

// Where lines go to the journal, it learns how grave each is (sd-daemon(3)).
std::string grade_for_journal(const std::string& kind) {
    const char* journal = std::getenv("JOURNAL_STREAM");
    if (journal == nullptr || *journal == '\0') return "";
    return kind == "error" ? "<3>" : kind == "warning" ? "<4>" : "<6>";
}

void log(LogLines& lines, const std::string& kind, const std::string& text) {
    for (const std::string_view line : split(text, '\n')) {
        lines.add(grade_for_journal(kind) + kind + ": " + std::string(line) + "\n");
    }
}

int run(const serve::ServiceOptions& options) {
    LogLines lines;
    const serve::ServiceTalk talk{
        .print = [](const std::string& line) { print(line + "\n"); },
        .log = [&lines](const std::string& kind,
                        const std::string& text) { log(lines, kind, text); }};
    const Status served = serve::run_service(options, talk);
    if (served.ok()) return kExitDone;
    const Code code = served.error().code;
    return complain(served.error(),
                    code == Code::BadInput || code == Code::NotFound ? kExitUsage : kExitFailed);
}

}  // namespace

void add_serve(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("serve", "runs a project on a robot, from its boot on");
    auto options = std::make_shared<serve::ServiceOptions>();  // owners: CLI11 and the callback
    takes_file(
        *verb->add_option("PROJECT", options->project, "a folder with a vagus.json")->required(),
        {"vagus.json"});
    verb->add_flag("--start", options->start,
                   "runs its plan and scripts as soon as the nodes are there");
    verb->add_flag("--stop-only", options->stop_only,
                   "stops the robot and ends: for a service manager, when a server is gone that "
                   "could not do it itself");
    verb->add_option("--target", options->target,
                     "instead of the project's own: sim, tcp:HOST:PORT, ser:DEVICE, can:INTERFACE")
        ->type_name("TARGET");
    add_door_options(*verb, options->door);
    verb->add_option("--fleet", options->fleet.target,
                     "the robot is in this fleet: mqtt[s]://HOST[:PORT]/FLEET")
        ->type_name("FLEET");
    verb->add_option("--robot", options->fleet.robot,
                     "its name there (default: that of this computer)")
        ->type_name("NAME");
    add_broker_options(*verb, options->fleet);
    verb->add_option("--data", options->data, "folder of the token (default: ~/.local/share/vagus)")
        ->type_name("FOLDER");
    verb->add_option("--config", options->config, "folder of settings (default: ~/.config/vagus)")
        ->type_name("FOLDER");
    verb->footer(
        "It prints `serve http://127.0.0.1:PORT/`, waits for nodes that are not there yet, and "
        "serves the\n"
        "studio's pages, /healthz and /metrics until it is interrupted; the robot is stopped "
        "then.\n"
        "\n"
        "Example:\n"
        "  vagus serve examples/follow-wall --start\n"
        "  vagus serve /var/lib/vagus/robot --start --target ser:/dev/ttyACM0 --listen 0.0.0.0 "
        "--token-file token\n"
        "  vagus serve examples/alarm --start --fleet mqtts://broker:8883/lab --tls-ca "
        "ca.crt --login r1.login");
    verb->callback([options, &exit_code] {
        check_door_options(options->door);
        exit_code = run(*options);
    });
}

}  // namespace vagus::cli
