// Where a fleet is, as people write it, and who one is there.
//
//     mqtt://HOST[:PORT][/FLEET]      mqtts://HOST[:PORT][/FLEET]
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace vagus::fleet {

constexpr uint16_t kMqttPort = 1883;
constexpr uint16_t kMqttsPort = 8883;

struct FleetTarget {
    std::string host;
    uint16_t port = kMqttPort;
    bool tls = false;
    std::string fleet;  // empty: the project's own
    friend bool operator==(const FleetTarget&, const FleetTarget&) = default;
};

Result<FleetTarget> parse_fleet_target(std::string_view text);
std::string to_string(const FleetTarget& target);

// What a file with two lines says, as `vagus fleet init` writes it: user, password.
struct Login {
    std::string user, password;
};
Result<Login> read_login(std::string_view text, const std::string& file);

}  // namespace vagus::fleet
