#include "serve/project/difference.hpp"

#include <algorithm>

namespace vagus::serve {

namespace {

bool continues(std::string_view text, size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
}

}  // namespace

TextDifference difference(std::string_view before, std::string_view after) {
    const size_t shorter = std::min(before.size(), after.size());
    size_t front = 0;
    while (front < shorter && before[front] == after[front]) ++front;
    // Characters that begin alike are not cut in two.
    while (front > 0 && (continues(before, front) || continues(after, front))) --front;
    size_t back = 0;
    while (back < shorter - front &&
           before[before.size() - 1 - back] == after[after.size() - 1 - back]) {
        ++back;
    }
    while (back > 0 && continues(before, before.size() - back)) --back;
    return {front, before.size() - back, after.substr(front, after.size() - back - front)};
}

}  // namespace vagus::serve
