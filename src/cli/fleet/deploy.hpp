// `vagus fleet TARGET deploy`: another version for robots of a fleet, in steps.
#pragma once

#include "cli/fleet/session.hpp"

namespace vagus::cli {

constexpr double kRolloutWait_s = 60;  // for a robot, from the want to its start

// The exit code: 0 if all who were chosen are well.
int deploy(FleetSession& session, const FleetCall& call);

}  // namespace vagus::cli
