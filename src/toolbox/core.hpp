// The `core` toolbox: what every plan can use, on every platform (docs/plans.md, section 7).
#pragma once

#include "run/code.hpp"

namespace vagus::toolbox {

void add_core(run::CodeLibrary& library);

}  // namespace vagus::toolbox
