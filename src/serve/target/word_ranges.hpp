// Words of a node that somebody looks at, as ranges. Whoever asks may name words twice; nobody does
// the work of that: ranges that overlap are one.
//
//     const WordRanges shown = merged({{0, 2}, {1, 6}, {6, 8}});   // {0, 6}, {6, 8}
//     has_some(shown, 4, 5);                                       // true
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vagus::serve {

struct WordRange {
    uint32_t first = 0;
    uint32_t end = 0;  // behind the last one
    uint32_t count() const { return end - first; }
    friend bool operator==(const WordRange&, const WordRange&) = default;
};
using WordRanges = std::vector<WordRange>;

// In ascending order, without overlap; those that only touch stay two.
WordRanges merged(WordRanges ranges);
// Whether one of the words from `first` to `end` is in the ranges, which are merged.
bool has_some(const WordRanges& ranges, uint32_t first, uint32_t end);
size_t words_in(const WordRanges& ranges);

}  // namespace vagus::serve
