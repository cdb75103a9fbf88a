// UTF-8 and the one question about characters that AESL asks: may it be in a word? (section 1.1,
// 1.3)
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace vagus::aesl {

// U+FEFF in UTF-8. At the start of a file it says nothing and is skipped.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

struct CodePoint {
    uint32_t value = 0;
    uint32_t length = 1;  // bytes
    bool valid = false;   // false: malformed UTF-8; `value` is the byte, `length` 1
};

// The code point at `offset`, which lies inside the text.
CodePoint decode(std::string_view text, size_t offset);

// Unicode property Alphabetic or general category Nd.
bool is_letter_or_digit(uint32_t code_point);

// How many code points the text has; a malformed byte counts as one.
int count_code_points(std::string_view text);

}  // namespace vagus::aesl
