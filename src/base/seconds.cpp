#include "base/seconds.hpp"

#include <fmt/format.h>

namespace vagus {

std::string seconds_text(Time at) {
    constexpr int64_t kMicroseconds = 1'000'000;  // in one second
    return fmt::format("{}.{:06}", at.count() / kMicroseconds, at.count() % kMicroseconds);
}

}  // namespace vagus
