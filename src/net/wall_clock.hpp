// The clock of the wall, which never goes back, for programs without a loop of their own
// (Loop::now() counts from its start).
#pragma once

#include <chrono>

#include "base/time.hpp"

namespace vagus::net {

inline Time wall_now() {
    return std::chrono::duration_cast<Time>(std::chrono::steady_clock::now().time_since_epoch());
}

}  // namespace vagus::net
