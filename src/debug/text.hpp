// Text that came over the bus, made fit to be shown: a node must not be able to send escape
// sequences to a terminal or broken UTF-8 into a JSON file.
#pragma once

#include <string>

#include "wire/bytes.hpp"

namespace vagus::debug {

// Control characters and bytes that are not UTF-8 become '?'.
std::string clean_text(wire::Text text);

}  // namespace vagus::debug
