#include "aesl/names.hpp"

#include <functional>

namespace vagus::aesl {
namespace {

constexpr std::string_view kSpellings[] = {
    "",
    "",
    "",
    "",
#define KEYWORD(name, spelling) spelling,
#include "aesl/tokens.def"
#undef KEYWORD
#define SIGN(name, spelling) spelling,
#include "aesl/tokens.def"
#undef SIGN
};

constexpr uint32_t kKeywords =
    static_cast<uint32_t>(kLastKeyword) - static_cast<uint32_t>(kFirstKeyword) + 1;

uint32_t hash_of(std::string_view name) {
    return static_cast<uint32_t>(std::hash<std::string_view>{}(name));
}

}  // namespace

Names::Names() : slots_(256, 0) {
    for (uint32_t i = 0; i < kKeywords; ++i) {
        intern(kSpellings[static_cast<uint32_t>(kFirstKeyword) + i]);
    }
}

NameId Names::intern(std::string_view name) {
    const uint32_t hash = hash_of(name);
    const size_t mask = slots_.size() - 1;
    size_t slot = hash & mask;
    while (slots_[slot] != 0) {
        const NameId id = slots_[slot] - 1;
        if (hashes_[id] == hash && texts_[id] == name) return id;
        slot = (slot + 1) & mask;
    }
    texts_.push_back(name);
    hashes_.push_back(hash);
    slots_[slot] = static_cast<uint32_t>(texts_.size());
    if (texts_.size() * 2 > slots_.size()) grow();
    return static_cast<NameId>(texts_.size() - 1);
}

void Names::grow() {
    slots_.assign(slots_.size() * 2, 0);
    const size_t mask = slots_.size() - 1;
    for (uint32_t id = 0; id < texts_.size(); ++id) {
        size_t slot = hashes_[id] & mask;
        while (slots_[slot] != 0) slot = (slot + 1) & mask;
        slots_[slot] = id + 1;
    }
}

TokenKind keyword_of(NameId id) {
    if (id >= kKeywords) return TokenKind::Identifier;
    return static_cast<TokenKind>(static_cast<uint32_t>(kFirstKeyword) + id);
}

std::string_view spelling_of(TokenKind kind) {
    return kSpellings[static_cast<size_t>(kind)];
}

}  // namespace vagus::aesl
