// vagus studio: the development environment, served to a browser.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "serve/process.hpp"
#include "serve/workbench/studio.hpp"

namespace vagus::cli {
namespace {

constexpr int kPortMax = 65535;

// There is a screen on which a browser can appear.
bool has_screen() {
    const auto said = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr && *value != '\0';
    };
    return said("DISPLAY") || said("WAYLAND_DISPLAY");
}

int run(const serve::StudioOptions& options, bool browser) {
    const Status served =
        serve::run_studio(options, {.print = [](const std::string& line) { print(line + "\n"); },
                                    .log = [](const std::string& line) { complain(line); },
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

// Who may reach it, and how.
void add_door_options(CLI::App& verb, serve::StudioOptions& options) {
    verb.add_option("--listen", options.listen,
                    "an address of this computer; any but 127.0.0.1 needs --token-file")
        ->type_name("ADDRESS");
    verb.add_option("--port", options.port, "0 is a free one (default: 8910, if it is free)")
        ->type_name("N")
        ->check(CLI::Range(0, kPortMax));
    takes_file(*verb.add_option("--token-file", options.token_file,
                                "the token of who may drive; made if it is not there"),
               {});
    takes_file(*verb.add_option("--look-token-file", options.look_token_file,
                                "the token of who may only look; made if it is not there"),
               {});
    takes_file(*verb.add_option("--tls-cert", options.tls_cert, "PEM: serve by HTTPS"), {".pem"});
    takes_file(*verb.add_option("--tls-key", options.tls_key, "PEM: the key of the certificate"),
               {".pem"});
    verb.add_option("--host", options.hosts, "a further name that this computer has")
        ->type_name("NAME")
        ->allow_extra_args(false);
}

}  // namespace

void add_studio(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("studio", "the development environment, in the browser");
    auto options = std::make_shared<serve::StudioOptions>();  // owners: CLI11 and the callback
    auto no_browser = std::make_shared<bool>(false);
    takes_file(*verb->add_option("PROJECT", options->project,
                                 "a folder with a vagus.json, or an .aesl, plan or world; without "
                                 "it the start screen"),
               {"vagus.json", ".aesl", ".plan.json", ".world.json"});
    verb->add_option("--example", options->example,
                     "opens the newest copy of an example instead: --example follow-wall")
        ->type_name("NAME");
    add_door_options(*verb, *options);
    verb->add_option("--data", options->data,
                     "folder of copies, new projects, token (default: ~/.local/share/vagus)")
        ->type_name("FOLDER");
    verb->add_option("--config", options->config, "folder of settings (default: ~/.config/vagus)")
        ->type_name("FOLDER");
    verb->add_option("--pages", options->pages)->group("");  // for tests
    verb->add_flag("--no-browser", *no_browser, "only print the address");
    verb->footer(
        "It prints `studio http://127.0.0.1:PORT/#token=…`, opens a browser where there is a "
        "screen, and\n"
        "serves until it is interrupted; robots are stopped then.\n"
        "\n"
        "Example:\n"
        "  vagus studio examples/follow-wall\n"
        "  vagus studio --listen 192.168.1.7 --token-file token --tls-cert me.pem --tls-key "
        "me.key");
    verb->callback([options, no_browser, &exit_code] {
        const bool open_address = options->listen != "127.0.0.1" && options->listen != "::1";
        if (open_address && options->token_file.empty()) {
            throw CLI::ValidationError("--listen", options->listen +
                                                       " needs --token-file FILE: who reaches this "
                                                       "address must know the token");
        }
        if (options->tls_cert.empty() != options->tls_key.empty()) {
            throw CLI::ValidationError("--tls-cert", "--tls-cert and --tls-key go together");
        }
        exit_code = run(*options, !*no_browser);
    });
}

}  // namespace vagus::cli
