#include "serve/edit/text_places.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "serve/project/utf16.hpp"

namespace vagus::serve {

TextPlaces::TextPlaces(std::string_view text) : text_(text) {
    lines_.push_back({});
    size_t unit = 0;
    for (size_t at = 0; at < text.size(); ++at) {
        const auto letter = static_cast<unsigned char>(text[at]);
        if (!is_utf8_continuation(text[at])) unit += letter >= 0xf0 ? 2 : 1;
        if (text[at] == '\n') lines_.push_back({at + 1, unit});
    }
}

std::string_view TextPlaces::line(size_t line) const {
    if (line == 0 || line > lines_.size()) return {};
    const size_t begin = lines_[line - 1].byte;
    const size_t end = line < lines_.size() ? lines_[line].byte - 1 : text_.size();
    std::string_view found = text_.substr(begin, end - begin);
    if (found.ends_with('\r')) found.remove_suffix(1);
    return found;
}

size_t TextPlaces::byte_of(aesl::Position at) const {
    if (at.line < 1) return 0;
    const auto number = static_cast<size_t>(at.line);
    if (number > lines_.size()) return text_.size();
    const std::string_view text = line(number);
    size_t byte = 0;
    for (int column = 1; column < at.column && byte < text.size(); ++column) {
        ++byte;
        while (byte < text.size() && is_utf8_continuation(text[byte])) ++byte;
    }
    return lines_[number - 1].byte + byte;
}

size_t TextPlaces::line_at(size_t byte) const {
    const auto after = std::upper_bound(lines_.begin(), lines_.end(), byte,
                                        [](size_t at, const Line& line) { return at < line.byte; });
    return static_cast<size_t>(after - lines_.begin()) - 1;
}

size_t TextPlaces::unit_of_byte(size_t byte) const {
    byte = std::min(byte, text_.size());
    const Line& line = lines_[line_at(byte)];
    return line.unit + units_of(text_.substr(line.byte), byte - line.byte);
}

aesl::Position TextPlaces::position_of(size_t byte) const {
    byte = std::min(byte, text_.size());
    const size_t line = line_at(byte);
    int column = 1;
    for (size_t at = lines_[line].byte; at < byte; ++at) {
        if (!is_utf8_continuation(text_[at])) ++column;
    }
    return {static_cast<int>(line) + 1, column};
}

void PlaceCursor::walk_to(size_t byte) {
    for (; byte_ < byte && byte_ < text_.size(); ++byte_) {
        const char letter = text_[byte_];
        if (is_utf8_continuation(letter)) continue;
        unit_ += static_cast<unsigned char>(letter) >= 0xf0 ? 2 : 1;
        at_ = letter == '\n' ? aesl::Position{at_.line + 1, 1}
                             : aesl::Position{at_.line, at_.column + 1};
    }
}

aesl::Position PlaceCursor::position_of(size_t byte) {
    walk_to(byte);
    return at_;
}

size_t PlaceCursor::unit_of(size_t byte) {
    walk_to(byte);
    return unit_;
}

std::string_view line_at(std::string_view text, size_t line) {
    for (; line > 1; --line) {
        const size_t end = text.find('\n');
        if (end == text.npos) return {};
        text.remove_prefix(end + 1);
    }
    std::string_view found = text.substr(0, text.find('\n'));
    if (found.ends_with('\r')) found.remove_suffix(1);
    return found;
}

std::string line_of(std::string_view text, size_t bytes_max) {
    std::string line(utf8_prefix(text, bytes_max));
    for (char& letter : line) {
        if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) letter = ' ';
    }
    return line;
}

}  // namespace vagus::serve
