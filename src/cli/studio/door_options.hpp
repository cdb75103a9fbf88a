// Options of verbs that serve pages: who may reach them, and how.
#pragma once

namespace CLI {
class App;
}
namespace vagus::serve {
struct DoorOptions;
}

namespace vagus::cli {

void add_door_options(CLI::App& verb, serve::DoorOptions& options);
// What does not go together; throws CLI::ValidationError.
void check_door_options(const serve::DoorOptions& options);

}  // namespace vagus::cli
