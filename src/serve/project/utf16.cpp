#include "serve/project/utf16.hpp"

namespace vagus::serve {

namespace {

// The first byte of a character tells how long it is; from four bytes on it is a surrogate pair.
size_t bytes_of(unsigned char first) {
    return first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

}  // namespace

std::optional<size_t> byte_of_unit(std::string_view text, size_t units) {
    size_t at = 0;
    size_t passed = 0;
    while (passed < units && at < text.size()) {
        const size_t bytes = bytes_of(static_cast<unsigned char>(text[at]));
        passed += bytes == 4 ? 2 : 1;
        at += bytes;
    }
    if (passed != units || at > text.size()) return std::nullopt;
    return at;
}

size_t units_of(std::string_view text, size_t bytes) {
    size_t units = 0;
    for (size_t at = 0; at < bytes && at < text.size();) {
        const size_t size = bytes_of(static_cast<unsigned char>(text[at]));
        units += size == 4 ? 2 : 1;
        at += size;
    }
    return units;
}

}  // namespace vagus::serve
