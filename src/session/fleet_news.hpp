// News for a plan that asks its fleet: how a question to the keeper ended, a shared value, which
// robot is online. `vagus why` is told of them.
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
