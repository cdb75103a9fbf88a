// What actors, states and events of a plan and of the plans inside it are called: a text that is
// none of them never comes, and a test that waits for it would never say so.
#pragma once

#include <string>
#include <vector>

#include "plan/graph.hpp"

namespace vagus::trial {

// Each name once, those of the outermost plan first.
std::vector<std::string> actors_of(const plan::Graph& graph);
// That its supervisors can raise.
std::vector<std::string> events_of(const plan::Graph& graph);
std::vector<std::string> states_of(const plan::Graph& graph);

}  // namespace vagus::trial
