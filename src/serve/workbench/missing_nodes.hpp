// Nodes that a served robot waits for are told by their names.
#pragma once

namespace vagus::serve {

// In the place of a name: the project names none, and there is none.
constexpr const char* kAnyNode = "any node";

}  // namespace vagus::serve
