// The instructions that call a native: sizes, then addresses, the last first (section 4.1).
#pragma once

#include <string>
#include <vector>

#include "conformance/bench.hpp"

namespace vagus::conformance {

// For arguments that lie from `at` on, one behind the other, each with these words. lacking() if
// the node has no such native.
Result<Instructions> native_call(const Bench& bench, const std::string& name,
                                 const std::vector<Values>& arguments, uint16_t at);

}  // namespace vagus::conformance
