// Makes random programs and random things to do with them. Most of what it makes is sound, so that
// programs get somewhere; the rest is wrong in every way there is.
#pragma once

#include <cstdint>
#include <vector>

#include "base/rng.hpp"

namespace vagus::vm_peer {

// A program image of at most Geometry::kBytecode words: event vector, code.
std::vector<uint16_t> make_program(SplitMix64& rng);

// Anything, with a liking for the edges: 0, 1, -1, 32767, -32768, small numbers.
uint16_t make_value(SplitMix64& rng);

}  // namespace vagus::vm_peer
