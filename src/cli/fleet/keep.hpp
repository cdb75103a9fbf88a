// `vagus fleet TARGET keep`: the keeper of a fleet, at a broker anywhere.
#pragma once

#include "serve/broker/fleet_options.hpp"

namespace vagus::cli {

// Until a signal comes. While another keeper is there, this one stays out, and takes its place when
// it is gone. The exit code.
int keep(const serve::FleetOptions& broker);

}  // namespace vagus::cli
