#include "cli/screen/theme.hpp"

#include <charconv>
#include <cmath>

#include "cli/screen/keys.hpp"

namespace vagus::cli {
namespace {

constexpr double kBrightMax = 0.18;  // (1 + 0.05) / (0.18 + 0.05) = 4.57 to 1 on white

double linear(double part) {
    return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
}

// The brightness as a person sees it, 0 to 1.
double brightness(double r, double g, double b) {
    return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
}

double brightness(Rgb colour) {
    return brightness(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
}

// "ffff", "ff", "f": a part of a colour, by as many digits as the terminal likes.
std::optional<double> part_of(std::string_view digits) {
    unsigned value = 0;
    const char* end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, value, 16);
    if (digits.empty() || digits.size() > 4 || read.ec != std::errc() || read.ptr != end) {
        return std::nullopt;
    }
    return value / (std::pow(16, digits.size()) - 1);
}

// "11;rgb:ffff/ffff/ffff"; "rgba" has a fourth part.
std::optional<Theme> theme_of_answer(std::string_view text) {
    if (!text.starts_with("11;rgb")) return std::nullopt;
    const size_t colon = text.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    text.remove_prefix(colon + 1);
    double parts[3] = {};
    for (double& part : parts) {
        const size_t slash = text.find('/');
        const auto read = part_of(text.substr(0, slash));
        if (!read) return std::nullopt;
        part = *read;
        text.remove_prefix(slash == std::string_view::npos ? text.size() : slash + 1);
    }
    return brightness(parts[0], parts[1], parts[2]) > kBrightMax ? Theme::Light : Theme::Dark;
}

}  // namespace

BackgroundAnswer read_background(std::string_view bytes) {
    BackgroundAnswer answer;
    while (!bytes.empty()) {
        const size_t length = bytes[0] == '\x1b' ? sequence_length(bytes) : 1;
        if (length == 0) break;
        const std::string_view sequence = bytes.substr(0, length);
        if (sequence.starts_with("\x1b]")) {
            answer.theme =
                theme_of_answer(sequence.substr(2, sequence.find_last_not_of("\x07\x1b\\") - 1));
        } else if (sequence.starts_with("\x1b[?") && sequence.ends_with("c")) {
            answer.complete = true;
        } else {
            answer.typed += sequence;
        }
        bytes.remove_prefix(length);
    }
    answer.typed += bytes;
    return answer;
}

std::optional<Theme> theme_of_colorfgbg(std::string_view value) {
    const size_t last = value.rfind(';');
    if (last == std::string_view::npos) return std::nullopt;
    const std::string_view digits = value.substr(last + 1);
    int number = 0;
    const char* end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end || number < 0 || number > 15) return std::nullopt;
    // 7 and the bright ones, except the bright black.
    return number == 7 || number > 8 ? Theme::Light : Theme::Dark;
}

Rgb readable(Rgb colour, Theme theme) {
    if (theme == Theme::Dark) return colour;
    const auto darker = [](uint8_t part) { return static_cast<uint8_t>(part * 19 / 20); };
    while (brightness(colour) > kBrightMax) {
        colour = {darker(colour.r), darker(colour.g), darker(colour.b)};
    }
    return colour;
}

void make_readable(Grid& grid, Area area, Theme theme) {
    for (int row = area.row; row < area.row + area.rows; row++) {
        for (int column = area.column; column < area.column + area.columns; column++) {
            Cell cell = grid.at(column, row);
            if (!cell.ink.fore || cell.ink.back) continue;
            cell.ink.fore = readable(*cell.ink.fore, theme);
            grid.put(column, row, cell);
        }
    }
}

}  // namespace vagus::cli
