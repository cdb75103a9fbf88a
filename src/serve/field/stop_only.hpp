// `vagus serve PROJECT --stop-only`: stops the robot of a project and ends. For the service
// manager, once a server is gone that could not stop it itself.
#pragma once

#include "base/result.hpp"
#include "serve/field/service.hpp"

namespace vagus::serve {

constexpr Duration kReachWithin = 2s;  // for the robot's connection
constexpr Duration kNodesWithin =
    1500ms;  // for nodes to say what they are; they are stopped anyway

// Done: all nodes were read back as stopped, or there is nothing to stop. The Error names those
// that were not, or says why the robot cannot be reached.
Status stop_only(const ServiceOptions& options, const ServiceTalk& talk);

}  // namespace vagus::serve
