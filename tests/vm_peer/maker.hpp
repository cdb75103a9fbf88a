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

// A user event from anywhere, with up to two arguments more than a node has room for.
struct MadeEvent {
    uint16_t source;
    uint16_t type;
    std::vector<uint16_t> arguments;
};
MadeEvent make_event(SplitMix64& rng);

// Of the first program: VAGUS_SEED, or a new one.
uint64_t seed();

}  // namespace vagus::vm_peer
