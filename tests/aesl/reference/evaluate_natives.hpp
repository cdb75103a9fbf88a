// The native functions of appendix A of docs/spec/aesl-language.md once more, written from that
// page alone and for the host: plain loops, the deque as one reads it. For tests only.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reference/outcome.hpp"

namespace vagus::aesl {

// The arguments of a call, in order: words of the node's memory, or copies of values.
using NativeArguments = std::vector<std::span<int16_t>>;

// Calls the function of that name; the 30 standard ones, `sys.nop` and `sys.sum` exist. Gives what
// went wrong in it, if anything did. `random_state` is that of math.rand.
std::optional<FaultCause> call_native(std::string_view name, const NativeArguments& arguments,
                                      uint16_t& random_state);

}  // namespace vagus::aesl
