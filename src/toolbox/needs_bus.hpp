// What plans need of a bus: which cannot run alone, on which nodes they work, and by which events
// another plan would take these nodes away from them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "plan/graph.hpp"
#include "plan/template.hpp"
#include "toolbox/bus_talk.hpp"

namespace vagus::toolbox {

// Done if no template of the plans works over a bus; else an Error that names the first that does,
// without a fix: that is for the code that offers buses.
Status check_without_bus(const plan::Graph& graph);
// The same of a robot that is in no fleet.
Status check_without_fleet(const plan::Graph& graph);

// The nodes that the plans' templates work on: one of each list. No list twice.
std::vector<NodeNames> nodes_needed(const plan::Graph& graph);

// The events by which work begins on those nodes, whichever template of the library sends them.
// What templates begin that need other nodes, too, is left out.
std::set<std::string> starts_on(const std::vector<NodeNames>& nodes, const plan::Library& library);

}  // namespace vagus::toolbox
