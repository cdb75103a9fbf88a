#include "serve/target/word_ranges.hpp"

#include <algorithm>

namespace vagus::serve {

WordRanges merged(WordRanges ranges) {
    std::sort(ranges.begin(), ranges.end(),
              [](const WordRange& a, const WordRange& b) { return a.first < b.first; });
    WordRanges found;
    for (const WordRange& one : ranges) {
        if (one.count() == 0) continue;
        if (found.empty() || one.first >= found.back().end) {
            found.push_back(one);
        } else {
            found.back().end = std::max(found.back().end, one.end);
        }
    }
    return found;
}

bool has_some(const WordRanges& ranges, uint32_t first, uint32_t end) {
    const auto one =
        std::upper_bound(ranges.begin(), ranges.end(), first,
                         [](uint32_t word, const WordRange& range) { return word < range.end; });
    return one != ranges.end() && one->first < end;
}

size_t words_in(const WordRanges& ranges) {
    size_t count = 0;
    for (const WordRange& one : ranges) count += one.count();
    return count;
}

}  // namespace vagus::serve
