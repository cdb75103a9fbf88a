#include "serve/project/text_change.hpp"

#include <algorithm>
#include <utility>

#include "serve/project/utf16.hpp"

namespace vagus::serve {

std::optional<std::vector<TextDifference>> in_bytes(std::string_view text,
                                                    const std::vector<TextChange>& changes) {
    std::vector<const TextChange*> sorted;
    for (const TextChange& change : changes) sorted.push_back(&change);
    // What is put in at one place stays in its order.
    std::stable_sort(sorted.begin(), sorted.end(), [](const TextChange* a, const TextChange* b) {
        return std::pair(a->from, a->to) < std::pair(b->from, b->to);
    });
    std::vector<TextDifference> found;
    size_t unit = 0;
    size_t byte = 0;
    for (const TextChange* change : sorted) {
        if (change->from < unit || change->to < change->from) return std::nullopt;
        const auto before = byte_of_unit(text.substr(byte), change->from - unit);
        if (!before) return std::nullopt;
        const size_t from = byte + *before;
        const auto size = byte_of_unit(text.substr(from), change->to - change->from);
        if (!size) return std::nullopt;
        found.push_back({from, from + *size, change->text});
        byte = from + *size;
        unit = change->to;
    }
    return found;
}

std::vector<TextChange> in_units(std::string_view text,
                                 const std::vector<TextDifference>& changes) {
    std::vector<TextChange> found;
    size_t byte = 0;
    size_t unit = 0;
    const auto walk_to = [&](size_t to) {
        unit += units_of(text.substr(byte), to - byte);
        byte = to;
        return unit;
    };
    for (const TextDifference& change : changes) {
        const size_t from = walk_to(change.from);
        const size_t to = walk_to(change.to);
        found.push_back({from, to, std::string(change.insert)});
    }
    return found;
}

std::string applied(std::string_view text, const std::vector<TextDifference>& changes) {
    std::string result;
    size_t copied = 0;
    for (const TextDifference& change : changes) {
        result += text.substr(copied, change.from - copied);
        result += change.insert;
        copied = change.to;
    }
    result += text.substr(copied);
    return result;
}

std::optional<std::string> applied(std::string_view text, const std::vector<TextChange>& changes) {
    const auto found = in_bytes(text, changes);
    if (!found) return std::nullopt;
    return applied(text, *found);
}

}  // namespace vagus::serve
