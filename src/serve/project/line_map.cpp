#include "serve/project/line_map.hpp"

#include <algorithm>

namespace vagus::serve {

LineMap::LineMap(std::string_view before, std::string_view after)
    : lines_(lines_of(before).size()),
      changes_(line_differences(lines_of(before), lines_of(after))) {}

std::optional<int> LineMap::after(int line) const {
    if (line < 1) return std::nullopt;
    if (same()) return line;
    const auto at = static_cast<size_t>(line) - 1;
    if (at >= lines_) return std::nullopt;
    size_t now = at;
    for (const LineDifference& one : changes_) {
        if (one.from > at) break;
        if (at < one.to) {
            // A line that was changed stays one; where fewer took the place of many, the last went.
            now = one.at + (at - one.from);
            return now < one.end ? std::optional(static_cast<int>(now) + 1) : std::nullopt;
        }
        now = one.end + (at - one.to);
    }
    return static_cast<int>(now) + 1;
}

}  // namespace vagus::serve
