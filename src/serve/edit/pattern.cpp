#include "serve/edit/pattern.hpp"

#include "base/text.hpp"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <cctype>
#include <tuple>

namespace vagus::serve {

namespace {

constexpr size_t kPartsAtOnce = 64;  // of an expression, that cost as much as one character
constexpr size_t kNowhere = std::string_view::npos;

// Letters of other scripts count as parts of words, their typographic signs do not.
bool is_word_at(std::string_view line, size_t at) {
    if (at >= line.size()) return false;
    size_t begin = at;
    while (begin > 0 && is_utf8_continuation(line[begin])) --begin;
    const auto byte = static_cast<unsigned char>(line[begin]);
    if (byte < 0x80) return byte == '_' || std::isalnum(byte) != 0;
    return !line.substr(begin).starts_with("\xe2\x80");  // U+2000 to U+203F: General Punctuation
}

bool is_whole(std::string_view line, size_t from, size_t to) {
    const bool begins = from == 0 || !is_word_at(line, from - 1) || !is_word_at(line, from);
    const bool ends = !is_word_at(line, to) || !is_word_at(line, to - 1);
    return begins && ends;
}

}  // namespace

Result<Pattern> Pattern::make(std::string_view text, Options options) {
    if (text.empty()) return Error{Code::BadInput, "there is nothing to look for"};
    re2::RE2::Options how;
    how.set_log_errors(false);
    how.set_case_sensitive(options.exact_case);
    how.set_max_mem(kPatternBytesMax);
    const std::string expression =
        options.regex ? std::string(text) : re2::RE2::QuoteMeta({text.data(), text.size()});
    auto made = std::make_shared<const re2::RE2>(expression, how);
    if (!made->ok()) {
        return Error{Code::BadInput,
                     fmt::format("the expression cannot be used: {}; to look for its characters as "
                                 "they are, switch expressions off",
                                 made->error())};
    }
    return Pattern(options, std::move(made));
}

std::optional<Pattern::Match> Pattern::find(std::string_view line, size_t from,
                                            size_t& steps) const {
    while (from < line.size() && steps > 0) {
        std::array<re2::StringPiece, kPatternGroups> groups;
        const int known = std::min<int>(kPatternGroups, expression_->NumberOfCapturingGroups() + 1);
        const bool found = expression_->Match({line.data(), line.size()}, from, line.size(),
                                              re2::RE2::UNANCHORED, groups.data(), known);
        const size_t looked_to =
            found ? static_cast<size_t>(groups[0].data() - line.data()) + groups[0].size()
                  : line.size();
        steps -= std::min(steps, (looked_to - from + 1) * step_size());
        if (!found) return std::nullopt;
        Match match;
        for (size_t i = 0; i < kPatternGroups; ++i) {
            const char* begin = groups[i].data();
            const size_t at = begin ? static_cast<size_t>(begin - line.data()) : kNowhere;
            match.groups[i] = {at, begin ? at + groups[i].size() : kNowhere};
        }
        std::tie(match.from, match.to) = match.groups[0];
        const bool good =
            match.to > match.from && (!options_.whole || is_whole(line, match.from, match.to));
        if (good) return match;
        from = match.from + 1;
        while (from < line.size() && is_utf8_continuation(line[from])) ++from;
    }
    return std::nullopt;
}

size_t Pattern::step_size() const {
    return 1 + static_cast<size_t>(expression_->ProgramSize()) / kPartsAtOnce;
}

std::string Pattern::replacement(const Match& match, std::string_view line,
                                 std::string_view by) const {
    if (!options_.regex) return std::string(by);
    std::string text;
    for (size_t i = 0; i < by.size(); ++i) {
        const bool marks = by[i] == '$' && i + 1 < by.size();
        const char next = marks ? by[i + 1] : '\0';
        if (next == '$' || (next >= '0' && next <= '9')) {
            ++i;
            if (next == '$') {
                text += '$';
                continue;
            }
            const auto [from, to] = match.groups[static_cast<size_t>(next - '0')];
            if (from != kNowhere && to != kNowhere) text += line.substr(from, to - from);
        } else {
            text += by[i];
        }
    }
    return text;
}

}  // namespace vagus::serve
