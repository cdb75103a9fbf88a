// The standard natives as section 4.2 lists them: names, and the sizes of their parameters (> 0
// words, < 0 number of a template). The position is the id on nodes that have them all.
#pragma once

#include <span>

#include "conformance/instructions.hpp"

namespace vagus::conformance {

struct StandardNative {
    const char* name;
    Values sizes;
};

std::span<const StandardNative> standard_natives();

}  // namespace vagus::conformance
