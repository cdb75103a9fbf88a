#include "debug/text.hpp"

#include <string_view>

#include "base/text.hpp"

namespace vagus::debug {
namespace {

bool is_control(char32_t value) {
    return value < 0x20 || (value >= 0x7f && value < 0xa0);
}

}  // namespace

std::string clean_text(wire::Text text) {
    std::string clean;
    std::string_view rest(text.bytes, text.size);
    while (!rest.empty()) {
        const CodePoint next = first_code_point(rest);
        const bool good = next.bytes > 0 && !is_control(next.value);
        clean += good ? rest.substr(0, next.bytes) : "?";
        rest.remove_prefix(next.bytes > 0 ? next.bytes : 1);
    }
    return clean;
}

}  // namespace vagus::debug
