// Where the lines of a text are after it was changed: a mark at a line stays with what is written
// there, or goes with it.
//
//     const LineMap map(before, after);
//     if (const auto line = map.after(7)) mark_at(*line); else remove_mark();
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "serve/project/difference.hpp"

namespace vagus::serve {

class LineMap {
public:
    LineMap(std::string_view before, std::string_view after);

    bool same() const { return changes_.empty(); }  // each line is where it was
    // Lines count from 1. Nothing: the line is gone, or there was none of that number.
    std::optional<int> after(int line) const;

private:
    size_t lines_ = 0;  // before
    std::vector<LineDifference> changes_;
};

}  // namespace vagus::serve
