#include "cli/screen/page.hpp"

#include <cmath>

namespace vagus::cli {

std::string fixed(double value, int decimals) {
    const auto scale = static_cast<int64_t>(std::pow(10, decimals));
    const int64_t whole = std::llround(std::abs(value) * static_cast<double>(scale));
    std::string digits = std::to_string(whole % scale);
    digits.insert(0, static_cast<size_t>(decimals) - digits.size(), '0');
    const bool minus = value < 0 && whole != 0;
    return (minus ? "-" : "") + std::to_string(whole / scale) + "." + digits;
}

std::string shortened(const std::string& text, int columns, Charset charset) {
    if (text_width(text) <= columns || columns < 2) return text;
    // Words here are figures and spaces, or names: cut at a character, never inside one.
    size_t end = 0;
    int width = 0;
    while (end < text.size() && width < columns - 1) {
        do end++;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u);
        width = text_width(std::string_view(text).substr(0, end));
    }
    return text.substr(0, end) + (charset == Charset::Ascii ? "~" : "…");
}

void more(Page& page, size_t count, Charset charset) {
    const std::string dots = charset == Charset::Ascii ? "... " : "… ";
    page.add(dots + std::to_string(count) + " more", {kDim, {}, false});
    page.next();
}

void heading(Page& page, std::string_view words, Charset charset) {
    if (page.rows_left() < 2) return;
    const std::string rule = charset == Charset::Ascii ? "-" : "─";
    page.add(rule + rule + " ", {kDim, {}, false});
    page.add(words, {kHead, {}, true});
    page.add(" ", {});
    while (page.column() < page.columns()) page.add(rule, {kDim, {}, false});
    page.next();
}

}  // namespace vagus::cli
