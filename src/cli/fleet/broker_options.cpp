#include "cli/fleet/broker_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/options.hpp"
#include "serve/broker/fleet_options.hpp"
#include "serve/web/shelf.hpp"

namespace vagus::cli {

void add_broker_options(CLI::App& verb, serve::FleetOptions& options) {
    takes_file(*verb.add_option("--tls-ca", options.ca,
                                "PEM: who signed the certificate of the broker (with mqtts:; "
                                "default: those of this computer)"),
               {".crt", ".pem"});
    takes_file(*verb.add_option("--login", options.login,
                                "a file with two lines: user and password at the broker"),
               {".login"});
    add_certificate_options(verb,
                            {.certificate = "--client-cert",
                             .key = "--client-key",
                             .help = "a certificate instead of a login"},
                            options.certificate, options.key);
}

void add_shelf_options(CLI::App& verb, serve::ShelfOptions& shelf, const ShelfWords& words) {
    verb.add_option(shelf.listen_word, shelf.listen, words.listen)->type_name("ADDRESS:PORT");
    verb.add_option(words.host_option, shelf.host, words.host)->type_name("NAME");
    add_certificate_options(
        verb,
        {.certificate = shelf.certificate_word,
         .key = shelf.key_word,
         .help = "certificate of that name; robots trust who signed it by their --tls-ca"},
        shelf.certificate, shelf.key);
}

}  // namespace vagus::cli
