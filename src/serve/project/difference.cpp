#include "serve/project/difference.hpp"

#include "base/text.hpp"

#include <algorithm>

namespace vagus::serve {

namespace {

using Lines = std::vector<std::string_view>;

constexpr int kLineStepsMax = 400;  // lines put in and taken out that are looked for singly

bool continues(std::string_view text, size_t at) {
    return at < text.size() && is_utf8_continuation(text[at]);
}

// The shortest way from one list of lines to the other (Myers 1986): furthest_[d] holds how far
// each diagonal gets with d lines put in or taken out.
class ShortestWay {
public:
    ShortestWay(const Lines& before, const Lines& after) : before_(before), after_(after) {}

    // The lines that both have, as pairs of indices; nothing if they have too little in common.
    bool find(std::vector<std::pair<int, int>>& common) {
        for (int steps = 0; steps <= kLineStepsMax; ++steps) {
            if (advance(steps)) {
                walk_back(steps, common);
                return true;
            }
        }
        return false;
    }

private:
    int before_size() const { return static_cast<int>(before_.size()); }
    int after_size() const { return static_cast<int>(after_.size()); }
    int reached(int steps, int diagonal) const {
        return furthest_[static_cast<size_t>(steps)][static_cast<size_t>(diagonal + steps)];
    }
    bool goes_down(int steps, int diagonal) const {
        return diagonal == -steps || (diagonal != steps && reached(steps - 1, diagonal - 1) <
                                                               reached(steps - 1, diagonal + 1));
    }
    int start_of(int steps, int diagonal) const {
        if (steps == 0) return 0;
        return goes_down(steps, diagonal) ? reached(steps - 1, diagonal + 1)
                                          : reached(steps - 1, diagonal - 1) + 1;
    }

    // True: the end is reached.
    bool advance(int steps) {
        std::vector<int> row(static_cast<size_t>(2 * steps + 1), -1);
        for (int diagonal = -steps; diagonal <= steps; diagonal += 2) {
            int x = start_of(steps, diagonal);
            while (x < before_size() && x - diagonal < after_size() && x - diagonal >= 0 &&
                   before_[static_cast<size_t>(x)] == after_[static_cast<size_t>(x - diagonal)]) {
                ++x;
            }
            row[static_cast<size_t>(diagonal + steps)] = x;
            if (x >= before_size() && x - diagonal >= after_size()) {
                end_ = diagonal;
                furthest_.push_back(std::move(row));
                return true;
            }
        }
        furthest_.push_back(std::move(row));
        return false;
    }

    void walk_back(int steps, std::vector<std::pair<int, int>>& common) const {
        int diagonal = end_;
        for (; steps >= 0; --steps) {
            const int start = start_of(steps, diagonal);
            for (int x = reached(steps, diagonal); x > start; --x) {
                common.emplace_back(x - 1, x - 1 - diagonal);
            }
            if (steps > 0) diagonal += goes_down(steps, diagonal) ? 1 : -1;
        }
        std::reverse(common.begin(), common.end());
    }

    const Lines& before_;
    const Lines& after_;
    std::vector<std::vector<int>> furthest_;
    int end_ = 0;
};

// As many lines before as after: most likely each was changed in itself.
void add_line_by_line(const LineDifference& all, const Lines& before, const Lines& after,
                      std::vector<LineDifference>& found) {
    for (size_t i = 0; i < all.to - all.from; ++i) {
        if (before[all.from + i] == after[all.at + i]) continue;
        found.push_back({all.from + i, all.from + i + 1, all.at + i, all.at + i + 1});
    }
}

void add(const LineDifference& one, const Lines& before, const Lines& after,
         std::vector<LineDifference>& found) {
    if (one.from == one.to && one.at == one.end) return;
    if (one.to - one.from == one.end - one.at) return add_line_by_line(one, before, after, found);
    found.push_back(one);
}

size_t offset_of(std::string_view text, const Lines& lines, size_t line) {
    return line < lines.size() ? static_cast<size_t>(lines[line].data() - text.data())
                               : text.size();
}

}  // namespace

TextDifference difference(std::string_view before, std::string_view after) {
    const size_t shorter = std::min(before.size(), after.size());
    size_t front = 0;
    while (front < shorter && before[front] == after[front]) ++front;
    // Characters that begin alike are not cut in two.
    while (front > 0 && (continues(before, front) || continues(after, front))) --front;
    size_t back = 0;
    while (back < shorter - front &&
           before[before.size() - 1 - back] == after[after.size() - 1 - back]) {
        ++back;
    }
    while (back > 0 && continues(before, before.size() - back)) --back;
    return {front, before.size() - back, after.substr(front, after.size() - back - front)};
}

Lines lines_of(std::string_view text) {
    Lines lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return lines;
}

std::vector<LineDifference> line_differences(const Lines& before, const Lines& after) {
    size_t front = 0;
    const size_t shorter = std::min(before.size(), after.size());
    while (front < shorter && before[front] == after[front]) ++front;
    size_t back = 0;
    while (back < shorter - front &&
           before[before.size() - 1 - back] == after[after.size() - 1 - back]) {
        ++back;
    }
    const LineDifference whole{front, before.size() - back, front, after.size() - back};
    const Lines old(before.begin() + static_cast<long>(whole.from),
                    before.begin() + static_cast<long>(whole.to));
    const Lines now(after.begin() + static_cast<long>(whole.at),
                    after.begin() + static_cast<long>(whole.end));
    std::vector<LineDifference> found;
    std::vector<std::pair<int, int>> common;
    if (!ShortestWay(old, now).find(common)) {
        add(whole, before, after, found);
        return found;
    }
    LineDifference next{whole.from, 0, whole.at, 0};
    for (const auto& [x, y] : common) {
        next.to = front + static_cast<size_t>(x);
        next.end = front + static_cast<size_t>(y);
        add(next, before, after, found);
        next.from = next.to + 1;
        next.at = next.end + 1;
    }
    next.to = whole.to;
    next.end = whole.end;
    add(next, before, after, found);
    return found;
}

std::vector<TextDifference> differences(std::string_view before, std::string_view after) {
    if (before == after) return {};
    const Lines old = lines_of(before);
    const Lines now = lines_of(after);
    std::vector<TextDifference> found;
    for (const LineDifference& lines : line_differences(old, now)) {
        const size_t from = offset_of(before, old, lines.from);
        const size_t to = offset_of(before, old, lines.to);
        const size_t at = offset_of(after, now, lines.at);
        const size_t end = offset_of(after, now, lines.end);
        TextDifference one = difference(before.substr(from, to - from), after.substr(at, end - at));
        one.from += from;
        one.to += from;
        found.push_back(one);
    }
    if (found.size() > kDifferencesMax) return {difference(before, after)};
    return found;
}

}  // namespace vagus::serve
