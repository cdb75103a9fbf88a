// Options of verbs that talk to a broker: who one is there, whom one trusts, and where robots of
// the fleet fetch another version.
#pragma once

#include <string>

namespace CLI {
class App;
}
namespace vagus::serve {
struct FleetOptions;
struct ShelfOptions;
}  // namespace vagus::serve

namespace vagus::cli {

void add_broker_options(CLI::App& verb, serve::FleetOptions& options);

struct ShelfWords {
    std::string listen, host;  // what these two are for
    std::string host_option;   // "--host"
};
// The other options have the names that are in the ShelfOptions.
void add_shelf_options(CLI::App& verb, serve::ShelfOptions& shelf, const ShelfWords& words);

}  // namespace vagus::cli
