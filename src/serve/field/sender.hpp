// `vagus deploy`: sends a project to a robot that serves itself, and tells what came of it.
#pragma once

#include <functional>
#include <string>

#include "base/result.hpp"
#include "serve/web/live_client.hpp"

namespace vagus::serve {

constexpr auto kAskForControlWithin = std::chrono::seconds(12);  // the driver has 10 s to answer
constexpr auto kAskAgainEvery = std::chrono::milliseconds(250);

// The folder of the project goes there.
using Say = std::function<void(const std::string& line)>;
// Each gives true if the robot runs what was asked for; `say` gets findings and what happened. The
// Error says why nothing was changed.
Result<bool> deploy(LiveClient& robot, const std::string& project, const Say& say);
Result<bool> roll_back(LiveClient& robot, const Say& say);
Status list_versions(LiveClient& robot, const Say& say);

}  // namespace vagus::serve
