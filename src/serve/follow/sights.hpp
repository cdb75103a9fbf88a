// What is drawn of robots beside their poses: where their sensors look, and their lamps. Pages are
// sent all of them at once, the topic rays; the history keeps them robot by robot.
//
//     rays_payload(looks_of_a + looks_of_b, lamps_of_a + lamps_of_b)
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vagus::serve {

// The layouts are those of the topic rays in protocol.json.
constexpr size_t kLookBytes = 20;
constexpr size_t kLampBytes = 24;

// The payload of the topic, of whole looks and lamps.
std::string rays_payload(std::string_view looks, std::string_view lamps);

}  // namespace vagus::serve
