// What text.search looks for: a text or a regular expression, in one line at a time. Expressions
// are those of RE2, whose time grows with their size times the length of the line, however they are
// made; the caller gives how many such steps must do.
//
//     auto pattern = Pattern::make("speed(.*)", {.regex = true});
//     size_t steps = kSearchStepsMax;
//     if (auto match = pattern.value().find(line, 0, steps)) show(match->from, match->to);
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.hpp"

namespace re2 {
class RE2;
}

namespace vagus::serve {

constexpr int64_t kPatternBytesMax = 1 << 20;  // of a compiled expression
constexpr size_t kPatternGroups = 10;          // $0 to $9

class Pattern {
public:
    struct Options {
        bool regex = false;
        bool exact_case = false;
        bool whole = false;  // words only
    };
    struct Match {
        size_t from = 0, to = 0;  // bytes
        // $0 to $9; npos where a group took no part.
        std::array<std::pair<size_t, size_t>, kPatternGroups> groups{};
    };

    // The Error says what is wrong with the expression.
    static Result<Pattern> make(std::string_view text, Options options);

    // The first match of at least one character at or behind `from`. Nothing also when the steps
    // are used up: then `steps` is 0.
    std::optional<Match> find(std::string_view line, size_t from, size_t& steps) const;
    // What replaces a match: `by`, with $0 to $9 and $$ if this is an expression.
    std::string replacement(const Match& match, std::string_view line, std::string_view by) const;

private:
    Pattern(Options options, std::shared_ptr<const re2::RE2> expression)
        : options_(options), expression_(std::move(expression)) {}

    size_t step_size() const;  // of one character

    Options options_;
    // Owners: all copies of this pattern. Never changed.
    std::shared_ptr<const re2::RE2> expression_;
};

}  // namespace vagus::serve
