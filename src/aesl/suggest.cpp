#include "aesl/suggest.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "aesl/limits.hpp"
#include "aesl/unicode.hpp"

namespace vagus::aesl {
namespace {

std::u32string code_points(std::string_view text) {
    std::u32string points;
    for (size_t i = 0; i < text.size();) {
        const CodePoint point = decode(text, i);
        points += static_cast<char32_t>(point.value);
        i += point.length;
    }
    return points;
}

// Levenshtein distance, or anything above `limit` if it is above. Only the cells within `limit` of
// the diagonal are looked at, so the time is linear in the length.
int distance(const std::u32string& a, const std::u32string& b, int limit) {
    const int rows = static_cast<int>(a.size());
    const int columns = static_cast<int>(b.size());
    if (std::abs(rows - columns) > limit) return limit + 1;
    std::vector<int> row(b.size() + 1, limit + 1);
    for (int j = 0; j <= std::min(columns, limit); ++j) row[static_cast<size_t>(j)] = j;
    for (int i = 1; i <= rows; ++i) {
        const int from = std::max(1, i - limit);
        const int to = std::min(columns, i + limit);
        int diagonal = row[static_cast<size_t>(from - 1)];
        row[static_cast<size_t>(from - 1)] = from == 1 && i <= limit ? i : limit + 1;
        for (int j = from; j <= to; ++j) {
            const auto at = static_cast<size_t>(j);
            const int same = diagonal + (a[static_cast<size_t>(i - 1)] != b[at - 1]);
            diagonal = row[at];
            row[at] = std::min({same, diagonal + 1, row[at - 1] + 1});
        }
        if (to < columns) row[static_cast<size_t>(to + 1)] = limit + 1;
    }
    return row[b.size()];
}

}  // namespace

std::string in_small_letters(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c;
    return lower;
}

std::string_view same_letters(std::string_view name, std::span<const std::string_view> candidates) {
    const std::string wanted = in_small_letters(name);
    std::string_view first;
    for (const std::string_view candidate : candidates) {
        if (candidate == name || in_small_letters(candidate) != wanted) continue;
        if (first.empty() || candidate < first) first = candidate;
    }
    return first;
}

std::string_view closest(std::string_view name, std::span<const std::string_view> candidates) {
    constexpr size_t kBytesOfCodePointMax = 4;
    const std::u32string wanted = code_points(name);
    std::string_view best;
    int best_distance = kGuessDistanceMax + 1;
    for (const std::string_view candidate : candidates) {
        const size_t longest = (wanted.size() + kGuessDistanceMax) * kBytesOfCodePointMax;
        if (candidate.empty() || candidate.size() > longest) continue;
        const int d = distance(wanted, code_points(candidate), kGuessDistanceMax);
        // A name of which no character is left is no suggestion: "a" for "q", "id" for "no".
        if (d == 0 || d >= static_cast<int>(wanted.size())) continue;
        // Bytes of UTF-8 compare in the order of their code points.
        if (d < best_distance || (d == best_distance && candidate < best)) {
            best = candidate;
            best_distance = d;
        }
    }
    return best_distance <= kGuessDistanceMax ? best : std::string_view{};
}

}  // namespace vagus::aesl
