// Small acts on text that several modules need: UTF-8, splitting, lists of words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vagus {

// One code point and the bytes it takes. `bytes` 0: the text does not begin with well-formed UTF-8
// (or is empty).
struct CodePoint {
    char32_t value = 0;
    size_t bytes = 0;
};

// The first code point of `text`. Overlong forms, surrogates and values above U+10FFFF are
// malformed.
CodePoint first_code_point(std::string_view text);

// `code_point` as UTF-8; it must be one (no surrogate, at most U+10FFFF).
std::string to_utf8(char32_t code_point);

// Offset of the first byte that is not well-formed UTF-8.
std::optional<size_t> malformed_utf8_at(std::string_view text);

// Number of code points; every byte of malformed text that is no continuation byte counts as one.
size_t count_code_points(std::string_view text);

// The parts between the separators: one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

// "a, b and c"
std::string list_of(const std::vector<std::string_view>& words);

}  // namespace vagus
