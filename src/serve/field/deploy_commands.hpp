// The commands deploy.begin to deploy.list of the protocol.
#pragma once

#include "serve/field/deployments.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

// All are borrowed.
void declare_deploy_commands(Desk& desk, const Versions& versions, Deployments& deployments);

}  // namespace vagus::serve
