#include "base/base64.hpp"

#include <algorithm>
#include <cstdint>

namespace vagus {

namespace {

constexpr std::string_view kBase64Letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t at = 0; at < bytes.size(); at += 3) {
        uint32_t group = 0;
        for (size_t i = 0; i < 3; ++i) {
            group = group << 8 |
                    (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0u);
        }
        for (size_t i = 0; i < 4; ++i) {
            const bool filled = at + i <= bytes.size();
            text += filled ? kBase64Letters[group >> (18 - 6 * i) & 63] : '=';
        }
    }
    return text;
}

std::optional<std::string> from_base64(std::string_view text) {
    if (text.size() % 4 != 0) return std::nullopt;
    const size_t letters = std::min(text.find('='), text.size());
    if (text.size() - letters > 2) return std::nullopt;
    for (const char rest : text.substr(letters)) {
        if (rest != '=') return std::nullopt;
    }
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    uint32_t group = 0;
    size_t bits = 0;
    for (const char letter : text.substr(0, letters)) {
        const size_t value = kBase64Letters.find(letter);
        if (value == kBase64Letters.npos) return std::nullopt;
        group = group << 6 | static_cast<uint32_t>(value);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(group >> bits & 0xff);
        group &= (1u << bits) - 1;
    }
    return group == 0 ? std::optional(bytes) : std::nullopt;
}

}  // namespace vagus
