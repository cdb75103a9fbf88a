// A broker of one's own: `vagus fleet init FOLDER` makes what it needs, `vagus fleet serve FOLDER`
// runs Debian's mosquitto with it, and the keepers of its fleets beside it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace CLI {
class App;
}

namespace vagus::cli {

constexpr size_t kFleetUsersMax = 1000;  // that one `init` adds

struct BrokerOptions {
    std::string folder;
    std::optional<uint16_t> port;      // 8883
    std::optional<uint16_t> web_port;  // 8884; WebSockets
    std::vector<std::string> hosts;    // further names of this computer
    std::vector<std::string> robots;   // that get a login
};

// What is there already stays as it is; robots that are new get a login, and names that are new a
// certificate. Gives a line for the person; empty: there is nothing to say.
Result<std::string> make_broker(const BrokerOptions& options);

constexpr size_t kKeptFleetsMax = 16;  // fleets of one `serve`

// Until a signal comes, or mosquitto ends by itself. A keeper that ends is started again. The exit
// code.
int serve_broker(const std::string& folder, const std::vector<std::string>& fleets);

void add_broker_verbs(CLI::App& fleet, int& exit_code);

}  // namespace vagus::cli
