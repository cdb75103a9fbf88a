// The way of simulated robots to a real broker: `vagus sim WORLD --fleet TARGET`.
#pragma once

#include <optional>

#include "base/result.hpp"
#include "cli/sim/run.hpp"
#include "session/world_fleet.hpp"

namespace vagus::cli {

// Nothing without --fleet. The Error says what is wrong with the target or a file.
Result<std::optional<session::WorldFleet::Door>> door_to_fleet(const SimRunOptions& options);

}  // namespace vagus::cli
