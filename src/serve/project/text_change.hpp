// Changes of a text as pages send them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vagus::serve {

// Offsets in UTF-16 units of the text before all changes of one edit.
struct TextChange {
    size_t from = 0, to = 0;
    std::string text;
};

// The text with all of them made; nothing if one lies outside of the text, inside a character, or
// over another.
std::optional<std::string> applied(std::string_view text, std::vector<TextChange> changes);

}  // namespace vagus::serve
