// The hand from above: what a person moves, puts, takes and presses in a world that stands there.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "base/result.hpp"

namespace vagus::sim {
class World;
}

namespace vagus::serve {

// One order of the server: move, put, take, press, tap, light. Gives the number of what was put.
// The Error says what is not there, or why it cannot be.
Result<std::optional<uint32_t>> hand(sim::World& world, const std::string& what,
                                     const nlohmann::json& told);

}  // namespace vagus::serve
