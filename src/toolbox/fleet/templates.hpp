// The toolbox `fleet`: tasks, claimed names, shared values, robots that wait for each other.
#pragma once

#include "run/code.hpp"
#include "toolbox/parts.hpp"

namespace vagus::toolbox {

// The parts are borrowed as long as the library lives.
void add_fleet(run::CodeLibrary& library, const Parts& parts);

}  // namespace vagus::toolbox
