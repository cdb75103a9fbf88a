#include "serve/project/text_change.hpp"

#include <algorithm>
#include <utility>

#include "serve/project/utf16.hpp"

namespace vagus::serve {

std::optional<std::string> applied(std::string_view text, std::vector<TextChange> changes) {
    // What is put in at one place stays in its order.
    std::stable_sort(changes.begin(), changes.end(), [](const TextChange& a, const TextChange& b) {
        return std::pair(a.from, a.to) < std::pair(b.from, b.to);
    });
    std::string result;
    size_t unit = 0;  // of the text that is left
    for (const TextChange& change : changes) {
        if (change.from < unit || change.to < change.from) return std::nullopt;
        const auto from = byte_of_unit(text, change.from - unit);
        if (!from) return std::nullopt;
        const auto size = byte_of_unit(text.substr(*from), change.to - change.from);
        if (!size) return std::nullopt;
        result += text.substr(0, *from);
        result += change.text;
        text.remove_prefix(*from + *size);
        unit = change.to;
    }
    result += text;
    return result;
}

}  // namespace vagus::serve
