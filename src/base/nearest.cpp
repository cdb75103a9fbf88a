#include "base/nearest.hpp"

#include <algorithm>

namespace vagus {
namespace {

constexpr size_t kWordMax = 64;  // longer words are not compared: the table is quadratic

// Damerau-Levenshtein distance in its restricted form (no letter is touched twice).
size_t distance(std::string_view from, std::string_view to) {
    std::vector<std::vector<size_t>> cost(from.size() + 1, std::vector<size_t>(to.size() + 1));
    for (size_t i = 0; i <= from.size(); i++) cost[i][0] = i;
    for (size_t j = 0; j <= to.size(); j++) cost[0][j] = j;
    for (size_t i = 1; i <= from.size(); i++) {
        for (size_t j = 1; j <= to.size(); j++) {
            const size_t differs = from[i - 1] == to[j - 1] ? 0 : 1;
            cost[i][j] =
                std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + differs});
            const bool swapped =
                i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
            if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost[from.size()][to.size()];
}

template <typename Word>
std::string nearest_of(std::string_view typed, const std::vector<Word>& known) {
    std::string best;
    size_t best_cost = kWordMax;
    if (typed.empty() || typed.size() > kWordMax) return best;
    for (const std::string_view word : known) {
        if (word.size() > kWordMax) continue;
        const bool begins = typed.size() > 1 && word.starts_with(typed);
        const size_t cost = begins ? 1 : distance(typed, word);
        if (cost > std::max<size_t>(1, word.size() / 3) || cost >= best_cost) continue;
        best = word;
        best_cost = cost;
    }
    return best;
}

}  // namespace

std::string nearest(std::string_view typed, const std::vector<std::string>& known) {
    return nearest_of(typed, known);
}

std::string nearest(std::string_view typed, const std::vector<std::string_view>& known) {
    return nearest_of(typed, known);
}

std::string known_instead(std::string_view typed, const std::vector<std::string>& known) {
    constexpr size_t kNamed = 12;
    const std::string near = nearest(typed, known);
    if (!near.empty()) return "did you mean " + near + "?";
    if (known.empty()) return "there is none";
    std::string words = "there are: ";
    for (size_t i = 0; i < std::min(known.size(), kNamed); ++i) {
        words += (i == 0 ? "" : ", ") + known[i];
    }
    if (known.size() > kNamed) {
        words += " and " + std::to_string(known.size() - kNamed) + " more";
    }
    return words;
}

}  // namespace vagus
