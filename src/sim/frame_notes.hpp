// What the frames of nodes tell about a world's happenings.
#pragma once

#include <optional>

#include "sim/world.hpp"
#include "wire/frame.hpp"

namespace vagus::sim {

// The user event in it, if it is one.
std::optional<Emitted> emitted_in(const wire::Frame& frame);
// The mistake of a script that it reports, if it does.
std::optional<Fault> fault_in(const wire::Frame& frame);

}  // namespace vagus::sim
