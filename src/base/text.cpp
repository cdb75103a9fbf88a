// UTF-8, splitting and lists: see text.hpp.
#include "base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace vagus {
namespace {

// Bytes of the sequence that `lead` begins, 0 if it begins none.
size_t sequence_length(uint8_t lead) {
    if (lead < 0x80) return 1;
    if (lead >= 0xc2 && lead <= 0xdf) return 2;
    if (lead >= 0xe0 && lead <= 0xef) return 3;
    if (lead >= 0xf0 && lead <= 0xf4) return 4;
    return 0;
}

bool is_allowed(char32_t value, size_t bytes) {
    if (value >= 0xd800 && value <= 0xdfff) return false;
    if (value > 0x10ffff) return false;
    constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};  // below it the form is overlong
    return value >= kSmallest[bytes];
}

std::string escaped(std::string_view text, std::string_view passing) {
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const CodePoint point = first_code_point(text);
        const size_t bytes = std::max<size_t>(point.bytes, 1);
        if (point.bytes == 0) {
            shown += fmt::format("\\x{:02x}", static_cast<uint8_t>(text[0]));
        } else if (is_obeyed(point.value) && passing.find(text[0]) == passing.npos) {
            shown += fmt::format("\\u{:04x}", static_cast<uint32_t>(point.value));
        } else {
            shown += text.substr(0, bytes);
        }
        text.remove_prefix(bytes);
    }
    return shown;
}

}  // namespace

CodePoint first_code_point(std::string_view text) {
    if (text.empty()) return {};
    const auto lead = static_cast<uint8_t>(text[0]);
    const size_t bytes = sequence_length(lead);
    if (bytes == 0 || text.size() < bytes) return {};
    if (bytes == 1) return {lead, 1};
    char32_t value = lead & (0xffu >> (bytes + 1));
    for (size_t i = 1; i < bytes; ++i) {
        if (!is_utf8_continuation(text[i])) return {};
        value = (value << 6) | (static_cast<uint8_t>(text[i]) & 0x3fu);
    }
    return is_allowed(value, bytes) ? CodePoint{value, bytes} : CodePoint{};
}

std::string to_utf8(char32_t code_point) {
    const auto byte = [](char32_t bits) { return static_cast<char>(static_cast<uint8_t>(bits)); };
    const auto tail = [&](int shift) { return byte(0x80u | ((code_point >> shift) & 0x3fu)); };
    if (code_point < 0x80) return {byte(code_point)};
    if (code_point < 0x800) return {byte(0xc0u | (code_point >> 6)), tail(0)};
    if (code_point < 0x10000) return {byte(0xe0u | (code_point >> 12)), tail(6), tail(0)};
    return {byte(0xf0u | (code_point >> 18)), tail(12), tail(6), tail(0)};
}

std::optional<size_t> malformed_utf8_at(std::string_view text) {
    size_t offset = 0;
    while (offset < text.size()) {
        const CodePoint point = first_code_point(text.substr(offset));
        if (point.bytes == 0) return offset;
        offset += point.bytes;
    }
    return std::nullopt;
}

std::string_view utf8_prefix(std::string_view text, size_t bytes_max) {
    if (text.size() <= bytes_max) return text;
    size_t size = bytes_max;
    while (size > 0 && is_utf8_continuation(text[size])) --size;
    return text.substr(0, size);
}

void append_number(std::string& to, int64_t number) {
    constexpr size_t kLongest = 20;  // a sign and 19 digits
    std::array<char, kLongest> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    to.append(digits.data(), end.ptr);
}

size_t count_code_points(std::string_view text) {
    return static_cast<size_t>(std::count_if(
        text.begin(), text.end(), [](char byte) { return !is_utf8_continuation(byte); }));
}

bool is_obeyed(char32_t c) {
    const bool control = c < 0x20 || (c >= 0x7f && c < 0xa0);
    const bool direction = c == 0x061c || c == 0x200e || c == 0x200f ||
                           (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
    return control || direction || c == 0x2028 || c == 0x2029 || c == 0xfeff;
}

std::string visible(std::string_view text) {
    return escaped(text, "");
}

std::string visible_lines(std::string_view text) {
    return escaped(text, "\n\t");
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    size_t start = 0;
    for (size_t end = text.find(separator); end != text.npos; end = text.find(separator, start)) {
        parts.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    parts.push_back(text.substr(start));
    return parts;
}

std::string_view trimmed(std::string_view text, std::string_view spaces) {
    const size_t first = text.find_first_not_of(spaces);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(spaces) - first + 1);
}

std::string small_letters(std::string_view text) {
    std::string small(text);
    for (char& c : small) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return small;
}

std::optional<uint64_t> decimal_number(std::string_view text) {
    uint64_t number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    return number;
}

std::string joined_lines(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += (&line == &lines.front() ? "" : "\n") + line;
    return text;
}

std::string hex_of(std::string_view bytes) {
    std::string text;
    for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<uint8_t>(byte));
    return text;
}

std::string list_of(const std::vector<std::string_view>& words) {
    std::string list;
    for (size_t i = 0; i < words.size(); ++i) {
        if (i > 0) list += i + 1 == words.size() ? " and " : ", ";
        list += words[i];
    }
    return list;
}

}  // namespace vagus
