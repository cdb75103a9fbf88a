#include "cli/fleet/broker_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/options.hpp"
#include "serve/broker/fleet_options.hpp"

namespace vagus::cli {

void add_broker_options(CLI::App& verb, serve::FleetOptions& options) {
    takes_file(*verb.add_option("--tls-ca", options.ca,
                                "PEM: who signed the certificate of the broker (with mqtts:; "
                                "default: those of this computer)"),
               {".crt", ".pem"});
    takes_file(*verb.add_option("--login", options.login,
                                "a file with two lines: user and password at the broker"),
               {".login"});
    CLI::Option* certificate = verb.add_option("--client-cert", options.certificate,
                                               "PEM: a certificate instead of a login");
    CLI::Option* key = verb.add_option("--client-key", options.key, "PEM: its key");
    takes_file(*certificate, {".crt", ".pem"});
    takes_file(*key, {".key", ".pem"});
    certificate->needs(key);
    key->needs(certificate);
}

}  // namespace vagus::cli
