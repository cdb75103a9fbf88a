// vagus deploy: another version of a project for a robot that serves itself.
#include <CLI/CLI.hpp>

#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "serve/access.hpp"
#include "serve/field/sender.hpp"

namespace vagus::cli {
namespace {

struct DeployOptions {
    std::string project, address, token_file, tls_cert;
    bool rollback = false, list = false;
};

Result<std::unique_ptr<serve::LiveClient>> meet(const DeployOptions& options) {
    serve::ServerAddress address = TRY(serve::parse_address(options.address));
    address.certificate = options.tls_cert;
    if (!options.token_file.empty()) {
        const std::string text = TRY(read_file(options.token_file));
        address.token = TRY(serve::token_in(text, options.token_file));
    }
    return serve::LiveClient::connect(address, "vagus deploy");
}

Result<bool> act(const DeployOptions& options) {
    const auto client = TRY(meet(options));
    const serve::Say say = [](const std::string& line) { print(line + "\n"); };
    if (options.list) {
        TRY(serve::list_versions(*client, say));
        return true;
    }
    if (options.rollback) return serve::roll_back(*client, say);
    return serve::deploy(*client, options.project, say);
}

int run(const DeployOptions& options) {
    const Result<bool> done = act(options);
    if (done.ok()) return done.value() ? kExitDone : kExitFailed;
    return complain(done.error(), done.error().code == Code::BadInput ? kExitUsage : kExitFailed);
}

}  // namespace

void add_deploy(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("deploy", "sends another version of a project to a robot");
    auto options = std::make_shared<DeployOptions>();  // owners: CLI11 and the callback
    takes_file(
        *verb->add_option("PROJECT", options->project, "a folder with a vagus.json")->required(),
        {"vagus.json"});
    verb->add_option("ADDRESS", options->address,
                     "of its `vagus serve`: HOST:PORT, or https://HOST:PORT/")
        ->required()
        ->type_name("ADDRESS");
    takes_file(*verb->add_option("--token-file", options->token_file,
                                 "the token of who may drive that robot"),
               {});
    takes_file(*verb->add_option("--tls-cert", options->tls_cert,
                                 "PEM: a certificate that is trusted, too"),
               {".pem"});
    auto* rollback = verb->add_flag("--rollback", options->rollback,
                                    "instead: the version before is in force again");
    verb->add_flag("--list", options->list, "instead: the versions that the robot keeps")
        ->excludes(rollback);
    verb->footer(
        "The robot checks what it got before anything changes, stops, puts it in force and starts "
        "it. If it\n"
        "does not start within 10 s the version before is in force again. The last five stay.\n"
        "\n"
        "Example:\n"
        "  vagus deploy examples/follow-wall robot.local --token-file token\n"
        "  vagus deploy examples/follow-wall robot.local --token-file token --rollback");
    verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vagus::cli
