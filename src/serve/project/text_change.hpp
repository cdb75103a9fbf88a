// Changes of a text as pages send them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "serve/project/difference.hpp"

namespace vagus::serve {

// Offsets in UTF-16 units of the text before all changes of one edit.
struct TextChange {
    size_t from = 0, to = 0;
    std::string text;
    friend bool operator==(const TextChange&, const TextChange&) = default;
};

// The same in bytes, in the order of their places; nothing if one lies outside of the text, inside
// a character, or over another. What they put in is borrowed from `changes`.
std::optional<std::vector<TextDifference>> in_bytes(std::string_view text,
                                                    const std::vector<TextChange>& changes);
// The way back: `changes` are in their order.
std::vector<TextChange> in_units(std::string_view text, const std::vector<TextDifference>& changes);

// The text with all of them made.
std::string applied(std::string_view text, const std::vector<TextDifference>& changes);
std::optional<std::string> applied(std::string_view text, const std::vector<TextChange>& changes);

}  // namespace vagus::serve
