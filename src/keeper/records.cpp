#include "keeper/records.hpp"

#include <charconv>

namespace vagus::keeper {

std::string text_of(Term term) {
    return std::to_string(term.epoch) + "." + std::to_string(term.number);
}

std::optional<Term> read_term(std::string_view text) {
    Term term;
    const char* const end = text.data() + text.size();
    const auto epoch = std::from_chars(text.data(), end, term.epoch);
    if (epoch.ec != std::errc() || epoch.ptr == end || *epoch.ptr != '.') return std::nullopt;
    const auto number = std::from_chars(epoch.ptr + 1, end, term.number);
    // One term has one text.
    if (number.ec != std::errc() || number.ptr != end || text_of(term) != text) return std::nullopt;
    return term;
}

}  // namespace vagus::keeper
