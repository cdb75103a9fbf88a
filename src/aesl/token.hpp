// One token of a program's text. The lists of words and signs are in tokens.def.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace vagus::aesl {

using TokenId = uint32_t;
using NameId = uint32_t;

enum class TokenKind : uint8_t {
    EndOfText,
    Bad,  // something that starts no token; its error has been reported by the scanner
    Identifier,
    Number,
#define KEYWORD(name, spelling) name,
#include "aesl/tokens.def"
#undef KEYWORD
#define SIGN(name, spelling) Sign##name,
#include "aesl/tokens.def"
#undef SIGN
};

constexpr TokenKind kFirstKeyword = TokenKind::Abs;
constexpr TokenKind kLastKeyword = TokenKind::While;
constexpr bool is_keyword(TokenKind kind) {
    return kind >= kFirstKeyword && kind <= kLastKeyword;
}

// Value of a Number that was malformed: its error has been reported, whatever holds it must stay
// quiet.
constexpr int32_t kBadNumber = -1;

struct Token {
    TokenKind kind = TokenKind::EndOfText;
    bool is_decimal = true;  // Number: no 0x or 0b
    int32_t line = 0;        // from 1
    int32_t column = 0;      // from 1, in code points
    uint32_t offset = 0;     // of its first byte in the source
    uint32_t length = 0;     // bytes
    int32_t value = 0;       // Number: 0 … 65535 or kBadNumber; Identifier: its NameId
};

using Tokens = std::vector<Token>;

}  // namespace vagus::aesl
