#include "cli/screen/page.hpp"

#include <cmath>

namespace vagus::cli {
namespace {

bool begins_character(const std::string& text, size_t at) {
    return at == text.size() || (static_cast<unsigned char>(text[at]) & 0xc0u) != 0x80u;
}

// The longest beginning that takes so many columns: whole characters.
std::string front_of(const std::string& text, int columns) {
    size_t end = 0;
    for (size_t at = 1; at <= text.size(); at++) {
        if (!begins_character(text, at)) continue;
        if (text_width(std::string_view(text).substr(0, at)) > columns) break;
        end = at;
    }
    return text.substr(0, end);
}

std::string back_of(const std::string& text, int columns) {
    size_t start = text.size();
    for (size_t at = text.size(); at-- > 0;) {
        if (!begins_character(text, at)) continue;
        if (text_width(std::string_view(text).substr(at)) > columns) break;
        start = at;
    }
    return text.substr(start);
}

}  // namespace

std::string fixed(double value, int decimals) {
    const auto scale = static_cast<int64_t>(std::pow(10, decimals));
    const int64_t whole = std::llround(std::abs(value) * static_cast<double>(scale));
    std::string digits = std::to_string(whole % scale);
    digits.insert(0, static_cast<size_t>(decimals) - digits.size(), '0');
    const bool minus = value < 0 && whole != 0;
    return (minus ? "-" : "") + std::to_string(whole / scale) + "." + digits;
}

std::string shortened(const std::string& text, int columns, Charset charset) {
    if (text_width(text) <= columns) return text;
    if (columns < 3) return front_of(text, std::max(columns, 0));
    const int back = (columns - 1) / 2;
    return front_of(text, columns - 1 - back) + (charset == Charset::Ascii ? "~" : "…") +
           back_of(text, back);
}

void Page::add_right(const std::string& words, const Ink& ink) {
    const int left = area_.columns - column_;
    const std::string shown = shortened(words, column_ == 0 ? left : left - 1, charset_);
    jump(area_.columns - text_width(shown));
    add(shown, ink);
}

void Page::pair(const std::string& name, const Ink& name_ink, const std::string& value,
                const Ink& value_ink) {
    const int room = columns() - 1;
    const int name_min = std::min(text_width(name), room - room / 2);
    const std::string right = shortened(value, room - name_min, charset_);
    add(shortened(name, room - text_width(right), charset_), name_ink);
    add_right(right, value_ink);
    next();
}

void more(Page& page, size_t count) {
    const std::string dots = page.charset() == Charset::Ascii ? "... " : "… ";
    page.add(dots + std::to_string(count) + " more", {kDim, {}, false});
    page.next();
}

void heading(Page& page, std::string_view words) {
    if (page.rows_left() < 2) return;
    const std::string rule = page.charset() == Charset::Ascii ? "-" : "─";
    page.add(rule + rule + " ", {kDim, {}, false});
    page.add(words, {kHead, {}, true});
    page.add(" ", {});
    while (page.column() < page.columns()) page.add(rule, {kDim, {}, false});
    page.next();
}

}  // namespace vagus::cli
