// What there is new for a plan that asks its fleet: how a question to the keeper has ended, a
// shared value, who is online. For one who asks why.
#pragma once

#include <string>
#include <variant>

#include "keeper/leases.hpp"

namespace vagus::session {

struct RobotOnline {
    std::string robot;
    bool online = true;
};
using FleetNews = std::variant<keeper::Over, keeper::Shared, RobotOnline>;

}  // namespace vagus::session
