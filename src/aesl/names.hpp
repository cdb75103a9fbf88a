// Names as small numbers: equal names have equal ids, so that all later phases look up by index.
// Borrows the characters: whatever was interned must outlive the table.
#pragma once

#include <string_view>
#include <vector>

#include "aesl/token.hpp"

namespace vagus::aesl {

class Names {
public:
    Names();

    // The id of that name, a new one if it is not known yet. Keywords have the first ids, in the
    // order of tokens.def.
    NameId intern(std::string_view name);

    std::string_view text(NameId id) const { return texts_[id]; }
    size_t size() const { return texts_.size(); }

private:
    void grow();

    std::vector<std::string_view> texts_;
    std::vector<uint32_t> hashes_;
    std::vector<uint32_t> slots_;  // id + 1, 0 where free; open addressing, a power of two in size
};

// Keyword of an interned name, or Identifier.
TokenKind keyword_of(NameId id);

// How a keyword or sign is written; empty for the other kinds.
std::string_view spelling_of(TokenKind kind);

}  // namespace vagus::aesl
