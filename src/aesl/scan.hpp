// Phase 1: text to tokens (docs/spec/aesl-language.md, section 1). Line ends separate tokens and
// nothing else; comments leave no trace. A malformed word or character is reported and becomes a
// Bad token or a kBadNumber, so that the parser goes on without a second error.
#pragma once

#include <string_view>

#include "aesl/diagnostics.hpp"
#include "aesl/names.hpp"
#include "aesl/token.hpp"

namespace vagus::aesl {

// The tokens in order; the last one is EndOfText. Words are interned into `names`, which borrows
// from `source`.
Tokens scan(std::string_view source, Names& names, Diagnostics& diagnostics);

// The range that a token covers.
Mark mark_of(std::string_view source, const Token& token);

// The token's text.
inline std::string_view text_of(std::string_view source, const Token& token) {
    return source.substr(token.offset, token.length);
}

// At most some 60 bytes of a text, for sentences; cut between code points.
std::string shown(std::string_view text);

}  // namespace vagus::aesl
