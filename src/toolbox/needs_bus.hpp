// Which plans cannot run alone.
#pragma once

#include "base/result.hpp"
#include "plan/graph.hpp"

namespace vagus::toolbox {

// Done if no template of the plans works over a bus; else an Error that names the first that does,
// without a mend: that is for whoever offers buses.
Status check_without_bus(const plan::Graph& graph);

}  // namespace vagus::toolbox
