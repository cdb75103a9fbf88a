#include "aesl/unicode.hpp"

#include <algorithm>
#include <iterator>

namespace vagus::aesl {
namespace {

struct LetterRange {
    uint32_t first;
    uint32_t last;
};

constexpr LetterRange kLetters[] = {
#define LETTERS(first, last) {first, last},
#include "aesl/letters.def"
#undef LETTERS
};

constexpr uint32_t kSurrogateFirst = 0xd800;
constexpr uint32_t kSurrogateLast = 0xdfff;
constexpr uint32_t kCodePointLast = 0x10ffff;

// Bytes of the sequence that this byte starts; 0 if it starts none.
uint32_t length_from(uint8_t lead) {
    if (lead < 0x80) return 1;
    if (lead >= 0xc2 && lead <= 0xdf) return 2;
    if (lead >= 0xe0 && lead <= 0xef) return 3;
    if (lead >= 0xf0 && lead <= 0xf4) return 4;
    return 0;
}

bool is_legal(uint32_t value, uint32_t length) {
    constexpr uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
    if (value < kSmallest[length] || value > kCodePointLast) return false;
    return value < kSurrogateFirst || value > kSurrogateLast;
}

}  // namespace

CodePoint decode(std::string_view text, size_t offset) {
    const auto lead = static_cast<uint8_t>(text[offset]);
    if (lead < 0x80) return {lead, 1, true};
    const CodePoint malformed{lead, 1, false};
    const uint32_t length = length_from(lead);
    if (length == 0 || offset + length > text.size()) return malformed;
    uint32_t value = lead & (0x7fu >> length);
    for (uint32_t i = 1; i < length; ++i) {
        const auto byte = static_cast<uint8_t>(text[offset + i]);
        if ((byte & 0xc0) != 0x80) return malformed;
        value = (value << 6) | (byte & 0x3fu);
    }
    return is_legal(value, length) ? CodePoint{value, length, true} : malformed;
}

bool is_letter_or_digit(uint32_t c) {
    if (c < 0x80) return (c >= '0' && c <= '9') || ((c | 0x20) >= 'a' && (c | 0x20) <= 'z');
    const LetterRange* range =
        std::lower_bound(std::begin(kLetters), std::end(kLetters), c,
                         [](const LetterRange& r, uint32_t v) { return r.last < v; });
    return range != std::end(kLetters) && range->first <= c;
}

int count_code_points(std::string_view text) {
    int count = 0;
    for (size_t i = 0; i < text.size(); i += decode(text, i).length) ++count;
    return count;
}

}  // namespace vagus::aesl
