#include "cli/studio/door_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/options.hpp"
#include "serve/workbench/door.hpp"

namespace vagus::cli {
namespace {

constexpr int kPortMax = 65535;

}  // namespace

void add_door_options(CLI::App& verb, serve::DoorOptions& options) {
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
    verb.add_option("--pages", options.pages)->group("");  // for tests
}

void check_door_options(const serve::DoorOptions& options) {
    const bool open_address = options.listen != "127.0.0.1" && options.listen != "::1";
    if (open_address && options.token_file.empty()) {
        throw CLI::ValidationError("--listen", options.listen +
                                                   " needs --token-file FILE: who reaches this "
                                                   "address must know the token");
    }
    if (options.tls_cert.empty() != options.tls_key.empty()) {
        throw CLI::ValidationError("--tls-cert", "--tls-cert and --tls-key go together");
    }
}

}  // namespace vagus::cli
