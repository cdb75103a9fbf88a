// vagus studio: the development environment, served to a browser.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "base/log_lines.hpp"
#include "cli/fleet/broker_options.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/studio/door_options.hpp"
#include "cli/verbs.hpp"
#include "serve/process.hpp"
#include "serve/workbench/studio.hpp"

namespace vagus::cli {
namespace {

// There is a screen on which a browser can appear.
bool has_screen() {
    const auto said = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr && *value != '\0';
    };
    return said("DISPLAY") || said("WAYLAND_DISPLAY");
}

int run(const serve::StudioOptions& options, bool browser) {
    LogLines lines;
    const Status served = serve::run_studio(
        options, {.print = [](const std::string& line) { print(line + "\n"); },
                  .log = [&lines](const std::string& line) { lines.complain(line); },
                  .show =
                      [browser](const std::string& file) {
                          if (browser && has_screen())
                              (void)serve::start_beside({"xdg-open", file});
                      }});
    if (served.ok()) return kExitDone;
    return complain(served.error(),
                    served.error().code == Code::BadInput || served.error().code == Code::NotFound
                        ? kExitUsage
                        : kExitFailed);
}

}  // namespace

void add_studio(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("studio", "the development environment, in the browser");
    auto options = std::make_shared<serve::StudioOptions>();  // owners: CLI11 and the callback
    auto no_browser = std::make_shared<bool>(false);
    takes_file(*verb->add_option("PROJECT", options->project,
                                 "the folder of a project, or of scripts, plans and worlds; "
                                 "one such file; or a recording: a project is made of its files; "
                                 "without it the start screen"),
               {"vagus.json", ".aesl", ".plan.json", ".world.json", ".mcap"});
    verb->add_option("--example", options->example,
                     "opens the newest copy of an example instead: --example follow-wall")
        ->type_name("NAME");
    add_door_options(*verb, options->door);
    verb->add_option("--fleet", options->fleet.target,
                     "also looks at the robots of this fleet: mqtt[s]://HOST[:PORT]/FLEET")
        ->type_name("TARGET");
    add_broker_options(*verb, options->fleet);
    options->shelf.listen_word = "--deploy-listen";
    options->shelf.certificate_word = "--deploy-cert";
    options->shelf.key_word = "--deploy-key";
    add_shelf_options(*verb, options->shelf,
                      {.listen = "where robots of the fleet fetch another version that a page "
                                 "gives them (default: a free port of 127.0.0.1, for a broker on "
                                 "this computer)",
                       .host = "name of this computer for these robots",
                       .host_option = "--deploy-host"});
    verb->add_option("--data", options->data,
                     "folder of copies, new projects, token (default: ~/.local/share/vagus)")
        ->type_name("FOLDER");
    verb->add_option("--config", options->config, "folder of settings (default: ~/.config/vagus)")
        ->type_name("FOLDER");
    verb->add_flag("--no-browser", *no_browser, "only print the address");
    verb->footer(
        "It prints `studio http://127.0.0.1:PORT/#token=…`, opens a browser where there is a "
        "screen, and\n"
        "serves until it is interrupted; robots are stopped then.\n"
        "\n"
        "Example:\n"
        "  vagus studio examples/follow-wall\n"
        "  vagus studio run.mcap\n"
        "  vagus studio --fleet mqtts://localhost:8883/lab --tls-ca broker/ca.crt --login "
        "broker/operator.login\n"
        "  vagus studio --listen 192.168.1.7 --token-file token --tls-cert me.pem --tls-key "
        "me.key");
    verb->callback([options, no_browser, &exit_code] {
        check_door_options(options->door);
        exit_code = run(*options, !*no_browser);
    });
}

}  // namespace vagus::cli
