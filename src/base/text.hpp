// Small acts on text that several modules need: UTF-8, splitting, lists of words.
#pragma once

#include <cstddef>
#include <cstdint>
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

// A byte inside of a character: behind its first one.
constexpr bool is_utf8_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// The longest beginning of `text` with at most `bytes_max` bytes that cuts no character in two.
std::string_view utf8_prefix(std::string_view text, size_t bytes_max);

// In decimal digits.
void append_number(std::string& to, int64_t number);

// Number of code points; every byte of malformed text that is no continuation byte counts as one.
size_t count_code_points(std::string_view text);

// A character that a terminal or the eye obeys instead of showing it: controls (C0, DEL, C1), what
// turns the direction of text (U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069), line
// and paragraph separators, a byte order mark.
bool is_obeyed(char32_t code_point);

// Text from outside for people's eyes, on one line: what is_obeyed() is written as JSON would,
// "\u001b", a byte that is no UTF-8 as "\x9b". So it may be used on JSON, too, and changes nothing
// in its meaning. visible_lines() lets line ends and tabs pass: for texts of several lines of ours.
std::string visible(std::string_view text);
std::string visible_lines(std::string_view text);

// The parts between the separators: one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

// Without these at its beginning and its end.
std::string_view trimmed(std::string_view text, std::string_view spaces = " \t");

// With a to z for A to Z; all else stays.
std::string small_letters(std::string_view text);

// The number below 2^64 that the text writes with digits 0 to 9 and nothing else.
std::optional<uint64_t> decimal_number(std::string_view text);

// Each on a line of its own, without an end behind the last.
std::string joined_lines(const std::vector<std::string>& lines);

// Two small hexadecimal digits for each byte.
std::string hex_of(std::string_view bytes);

// "a, b and c"
std::string list_of(const std::vector<std::string_view>& words);

}  // namespace vagus
