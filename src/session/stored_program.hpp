// The program that a node keeps over a restart (`WriteBytecode`, `vagus node --flash FILE`), as an
// object file (`.abo`): what `vagus compile --format abo` writes can be flashed, and a file of
// another node is refused.
#pragma once

#include <string>

#include "base/result.hpp"
#include "session/software_node.hpp"

namespace vagus::session {

// Replaces the file at once or leaves it as it was.
Status store_program(const SoftwareNode& node, const std::string& path);

enum class Stored { Loaded, Absent };

// Puts the program of the file into the node, without starting it. No file is no error: nothing was
// saved yet.
Result<Stored> load_stored_program(SoftwareNode& node, const std::string& path);

}  // namespace vagus::session
