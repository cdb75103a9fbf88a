// Options of verbs that talk to a broker: who one is there, and whom one trusts.
#pragma once

namespace CLI {
class App;
}
namespace vagus::serve {
struct FleetOptions;
}

namespace vagus::cli {

void add_broker_options(CLI::App& verb, serve::FleetOptions& options);

}  // namespace vagus::cli
