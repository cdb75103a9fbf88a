// Time as people and files have it: seconds.
#pragma once

#include <cmath>
#include <string>

#include "base/time.hpp"

namespace vagus {

// With all six decimals: "4.250000".
std::string seconds_text(Time at);
void append_seconds(std::string& to, Time at);

// To the nearest microsecond.
inline Duration from_seconds(double seconds) {
    return Duration(std::llround(seconds * 1e6));
}

}  // namespace vagus
