// Pictures as files; how they are read: read_png() of ground.hpp.
#pragma once

#include <string>

#include "sim/ground.hpp"

namespace vagus::sim {

// The bytes of a PNG. What they are hangs on the library that packs them; what they show does not.
std::string write_png(const Picture& picture);

}  // namespace vagus::sim
