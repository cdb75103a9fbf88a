#include "aesl/diagnostic.hpp"

#include <algorithm>

#include "aesl/unicode.hpp"

namespace vagus::aesl {
namespace {

// The byte at which a position lies.
size_t offset_of(std::string_view source, Position wanted) {
    size_t offset = 0;
    for (int line = 1; line < wanted.line; ++line) {
        const size_t end = source.find('\n', offset);
        if (end == source.npos) return source.size();
        offset = end + 1;
    }
    for (int column = 1; column < wanted.column; ++column) {
        if (offset >= source.size() || source[offset] == '\n') break;
        offset += decode(source, offset).length;
    }
    return offset;
}

}  // namespace

std::string with_edits(std::string_view source, const std::vector<Edit>& edits) {
    std::string text;
    size_t done = 0;
    for (const Edit& edit : edits) {
        const size_t from = std::max(done, offset_of(source, edit.range.at));
        text += source.substr(done, from - done);
        text += edit.text;
        done = std::max(from, offset_of(source, edit.range.end));
    }
    text += source.substr(done);
    return text;
}

}  // namespace vagus::aesl
