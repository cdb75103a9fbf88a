// What people say of a fleet: where it is, and who they are at its broker. The files are read here.
//
//     LinkOptions link = TRY(link_options({.target = "mqtt://broker/lab"}, operator_name()));
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "base/result.hpp"
#include "serve/broker/mosquitto_link.hpp"

namespace vagus::serve {

struct FleetOptions {
    std::string target = {};  // mqtt://HOST[:PORT]/FLEET; empty: in no fleet
    std::string robot = {};   // its name; empty: that of this computer
    std::string ca = {}, certificate = {}, key = {}, login = {};  // files
};

// The name of the robot that has these options.
std::string robot_name(const FleetOptions& options);

// How to reach the broker, of whatever asks. `client` is the id.
Result<LinkOptions> link_options(const FleetOptions& options, const std::string& client);
// The same for somebody who belongs to no project: the target must name the fleet.
Result<LinkOptions> link_of_fleet(const FleetOptions& options, const std::string& client);

// Of an operator: a robot of that name is improbable, and another operator, too.
std::string operator_name();
// Instance and epoch of a member, unlike those of any other and of its life before.
std::pair<std::string, int64_t> member_identity();

}  // namespace vagus::serve
